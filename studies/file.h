#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace flyball {

/// A file that could not be read or written: which one, and why.
class FileError : public std::runtime_error {
 public:
  FileError(const std::filesystem::path& file, std::string_view what, int error_number);
};

class OutputError : public FileError {
 public:
  using FileError::FileError;
};

/// The whole content of a file. Throws FileError.
std::string read_file(const std::filesystem::path& file);

/// Writes a file whole or not at all: a reader, or a crash at any time, sees the old content or the new.
/// Throws OutputError; the old file is then as it was.
void write_file(const std::filesystem::path& file, std::string_view content);

/// Throws the OutputError that `write_file` would throw at its start, before a long run is spent on it.
void require_writable(const std::filesystem::path& file);

/// A name beside `file` that nobody else uses, for what is written before it takes its name.
std::filesystem::path name_beside(const std::filesystem::path& file);

/// Gives `part`, written beside `file`, its name, for good. Throws OutputError and removes `part`.
void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file);

}  // namespace flyball
