#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "studies/run.h"
#include "studies/versions.h"

namespace flyball {

/// What a run was made from, for its metadata.
struct RunInputs {
  std::string model_file;
  std::string model_text;
  std::vector<Override> overrides;
};

/// The fingerprint of a model's text together with the files that it uses: a library that changes changes it.
std::string model_fingerprint(std::string_view model_text, const Diagram& diagram);

/// The sidecar of a result, as JSON text: model (with a hash of its text and of the files that it uses),
/// columns with units, solver with its tolerances and statistics, status, versions, and, where `csv` is
/// given, the file's name and checksum. An unknown unit is empty. Nothing in it depends on the machine's
/// speed: equal runs give equal bytes. Where `csv` is given, the last key is the checksum of all the text
/// before it.
std::string metadata_json(const RunResult& result, const RunInputs& inputs, std::string_view csv_name = {},
                          std::string_view csv = {});

/// What a sidecar says, for reports.
struct ResultFacts {
  std::string model_file, model_hash, title, source;
  std::vector<Override> overrides;
  std::string status, reason;  // as to_string(RunStatus)
  double end = 0.0, stop = 0.0;
  std::uint64_t seed = 1;
  std::string method, asked_method;
  double rtol = 0.0, atol = 0.0;
  std::vector<std::pair<std::string, std::string>> solver;  // name and value, for people
  std::vector<LogColumn> columns;                           // besides time
  Assessment assessment;
  std::string flyball;
  std::vector<Version> libraries;
};

/// Reads the text of `metadata_json`, with or without a CSV file. Throws MetadataError.
ResultFacts read_result_facts(std::string_view json);

/// What the sidecar says about its CSV file.
struct CsvMetadata {
  std::size_t rows = 0;
  std::vector<std::string> columns;
  std::string checksum;
};

/// A sidecar that is not what was written.
class MetadataError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the text of `metadata_json`. Throws MetadataError when a byte of it has changed.
CsvMetadata read_csv_metadata(std::string_view json);

}  // namespace flyball
