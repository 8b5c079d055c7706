#pragma once

#include <cstddef>
#include <cstdint>
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

/// The whole content of a file. Throws FileError, also when there is more than `most` bytes.
std::string read_file(const std::filesystem::path& file, std::size_t most = SIZE_MAX);

/// Writes a file whole or not at all: a reader, or a crash at any time, sees the old content or the new.
/// Throws OutputError; the old file is then as it was.
void write_file(const std::filesystem::path& file, std::string_view content);

/// Throws the OutputError that `write_file` would throw at its start, before a long run is spent on it.
void require_writable(const std::filesystem::path& file);

/// A name beside a file that nobody else uses. What stands under it is removed in the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& beside);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace flyball
