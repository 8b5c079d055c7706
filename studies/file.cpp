#include "studies/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace flyball {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }
  /// Some file systems report a full disk only here.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool sync_folder(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // EINVAL: the file system has nothing to sync there.
  return descriptor.get() >= 0 && (::fsync(descriptor.get()) == 0 || errno == EINVAL);
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

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

int create(const fs::path& part) {
  return ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/// Removes what was begun, and throws.
[[noreturn]] void give_up(const fs::path& part, const fs::path& file, int error_number) {
  ::unlink(part.c_str());
  throw OutputError(file, "cannot be written", error_number);
}

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

std::string read_file(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) throw FileError(file, "cannot be read", EISDIR);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) throw FileError(file, "cannot be read", errno);
  return content;
}

fs::path name_beside(const fs::path& file) {
  static std::atomic<unsigned> count = 0;
  const std::string name = fmt::format(".{}.{}.{}.part", file.filename().string(), ::getpid(), count++);
  return folder_of(file) / name;
}

void write_file(const fs::path& file, std::string_view content) {
  const fs::path target = destination(file);
  const fs::path part = name_beside(target);
  Descriptor descriptor(create(part));
  if (descriptor.get() < 0) throw OutputError(file, "cannot be written", errno);
  keep_mode(descriptor.get(), target);
  if (!write_all(descriptor.get(), content) || ::fsync(descriptor.get()) != 0 || !descriptor.close()) {
    give_up(part, file, errno);
  }
  put_in_place(part, target);
}

void require_writable(const fs::path& file) {
  const fs::path part = name_beside(destination(file));
  const Descriptor descriptor(create(part));
  if (descriptor.get() < 0) throw OutputError(file, "cannot be written", errno);
  ::unlink(part.c_str());
}

void put_in_place(const fs::path& part, const fs::path& file) {
  if (::rename(part.c_str(), file.c_str()) != 0) give_up(part, file, errno);
  if (!sync_folder(folder_of(file))) throw OutputError(file, "its folder cannot be synchronised", errno);
}

}  // namespace flyball
