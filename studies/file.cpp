#include "studies/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// Calls again when a signal came in between.
auto retried(auto&& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

class Descriptor {
 public:
  Descriptor(const fs::path& file, int flags)
      : fd_(retried([&] { return ::open(file.c_str(), flags | O_CLOEXEC, 0666); })) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }
  bool sync() const {
    return retried([&] { return ::fsync(fd_); }) == 0;
  }
  /// Some file systems report a full disk only here. After a signal the number is free, too.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0 || errno == EINTR; }

 private:
  int fd_;
};

bool write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = retried([&] { return ::write(fd, content.data(), content.size()); });
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// 0, or the number of the error.
int sync_folder(const fs::path& folder) {
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (descriptor.get() >= 0 && descriptor.sync()) return 0;
  const int error = errno;
  // The file system has nothing to sync there.
  return error == EINVAL ? 0 : error;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

fs::path name_beside(const fs::path& file) {
  static std::atomic<unsigned> count = 0;
  const std::string name = fmt::format(".{}.{}.{}.part", file.filename().string(), ::getpid(), count++);
  return folder_of(file) / name;
}

/// The file behind a link, so that the link stays. A device or folder is not replaced by a file.
fs::path destination(const fs::path& file) {
  std::error_code error;
  const fs::path target = fs::is_symlink(file, error) ? fs::weakly_canonical(file, error) : file;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) throw OutputError(file, "cannot be written", EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw OutputError(file, "cannot be written: not a regular file", 0);
  }
  return target;
}

constexpr int create = O_WRONLY | O_CREAT | O_EXCL;

void keep_mode(int fd, const fs::path& file) {
  struct stat old = {};
  if (::stat(file.c_str(), &old) == 0 && ::fchmod(fd, old.st_mode & 07777) != 0) {
    // A file system without modes: there is none to keep.
  }
}

}  // namespace

FileError::FileError(const fs::path& file, std::string_view what, int error_number)
    : std::runtime_error(error_number == 0
                             ? fmt::format("{}: {}", file.string(), what)
                             : fmt::format("{}: {}: {}", file.string(), what, std::strerror(error_number))) {}

std::string read_file(const fs::path& file, std::size_t most) {
  const Descriptor descriptor(file, O_RDONLY);
  if (descriptor.get() < 0) throw FileError(file, "cannot be read", errno);
  std::string content;
  std::size_t size = 0;
  for (;;) {
    content.resize(std::max<std::size_t>(2 * size, 1 << 16));
    const ssize_t got =
        retried([&] { return ::read(descriptor.get(), content.data() + size, content.size() - size); });
    if (got < 0) throw FileError(file, "cannot be read", errno);
    size += static_cast<std::size_t>(got);
    if (size > most) throw FileError(file, "cannot be read", EFBIG);
    if (got == 0) break;
  }
  content.resize(size);
  return content;
}

TemporaryFile::TemporaryFile(const fs::path& beside) : path_(name_beside(beside)) {}

TemporaryFile::~TemporaryFile() { ::unlink(path_.c_str()); }

void write_file(const fs::path& file, std::string_view content) {
  const fs::path target = destination(file);
  const TemporaryFile part(target);
  Descriptor descriptor(part.path(), create);
  if (descriptor.get() < 0) throw OutputError(file, "cannot be written", errno);
  keep_mode(descriptor.get(), target);
  if (!write_all(descriptor.get(), content) || !descriptor.sync() || !descriptor.close() ||
      retried([&] { return ::rename(part.path().c_str(), target.c_str()); }) != 0) {
    throw OutputError(file, "cannot be written", errno);
  }
  const int error = sync_folder(folder_of(target));
  if (error != 0) throw OutputError(file, "its folder cannot be synchronised", error);
}

void require_writable(const fs::path& file) {
  const TemporaryFile part(destination(file));
  const Descriptor descriptor(part.path(), create);
  if (descriptor.get() < 0) throw OutputError(file, "cannot be written", errno);
}

}  // namespace flyball
