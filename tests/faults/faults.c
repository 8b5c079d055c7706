/* Preloaded into flyball: makes one of its calls to the system fail.
 *
 *   FAULT_FOLDER   calls that concern files below this folder are counted, no others
 *   FAULT_CALL     open, read, write, fsync, rename, close, unlink, mkdir or truncate; those of a position and
 *                  of a data base's kind (pwrite, fdatasync) count as the plain ones
 *   FAULT_AT       the number of the call that fails, from 1
 *   FAULT_ERRNO    its error number; 0: a write that takes half of the bytes
 *   FAULT_MODE     once, or ever: all calls from that one on
 *   FAULT_REPORT   a file that is created when a call fails
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int is_below_folder(const char *path) {
  const char *folder = getenv("FAULT_FOLDER");
  return folder != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static int concerns_path(const char *path) {
  char folder[PATH_MAX];
  if (path[0] == '/') return is_below_folder(path);
  return getcwd(folder, sizeof folder) != NULL && is_below_folder(folder);
}

static int concerns_descriptor(int fd) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = '\0';
  return is_below_folder(path);
}

/* The programs that flyball starts are left alone. */
static int is_wanted(const char *call) {
  const char *wanted = getenv("FAULT_CALL");
  return wanted != NULL && strcmp(wanted, call) == 0 && strcmp(program_invocation_short_name, "flyball") == 0;
}

/* Whether this call fails; errno is set then. */
static int fails(const char *call, int concerned) {
  static int count = 0;
  if (!concerned || !is_wanted(call)) return 0;
  const int at = atoi(getenv("FAULT_AT"));
  ++count;
  if (count < at || (count > at && strcmp(getenv("FAULT_MODE"), "ever") != 0)) return 0;
  const long report = syscall(SYS_openat, AT_FDCWD, getenv("FAULT_REPORT"), O_WRONLY | O_CREAT, 0666);
  if (report >= 0) syscall(SYS_close, report);
  errno = atoi(getenv("FAULT_ERRNO"));
  return 1;
}

static mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

int open(const char *path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return fails("open", concerns_path(path)) ? -1 : NEXT(open)(path, flags, mode);
}

int open64(const char *path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return fails("open", concerns_path(path)) ? -1 : NEXT(open64)(path, flags, mode);
}

ssize_t read(int fd, void *buffer, size_t size) {
  return fails("read", concerns_descriptor(fd)) ? -1 : NEXT(read)(fd, buffer, size);
}

ssize_t write(int fd, const void *buffer, size_t size) {
  if (!fails("write", concerns_descriptor(fd))) return NEXT(write)(fd, buffer, size);
  return errno == 0 ? NEXT(write)(fd, buffer, (size + 1) / 2) : -1;
}

ssize_t pread64(int fd, void *buffer, size_t size, off64_t at) {
  return fails("read", concerns_descriptor(fd)) ? -1 : NEXT(pread64)(fd, buffer, size, at);
}

ssize_t pwrite64(int fd, const void *buffer, size_t size, off64_t at) {
  if (!fails("write", concerns_descriptor(fd))) return NEXT(pwrite64)(fd, buffer, size, at);
  return errno == 0 ? NEXT(pwrite64)(fd, buffer, (size + 1) / 2, at) : -1;
}

int ftruncate64(int fd, off64_t size) {
  return fails("truncate", concerns_descriptor(fd)) ? -1 : NEXT(ftruncate64)(fd, size);
}

int fdatasync(int fd) { return fails("fsync", concerns_descriptor(fd)) ? -1 : NEXT(fdatasync)(fd); }

int fsync(int fd) { return fails("fsync", concerns_descriptor(fd)) ? -1 : NEXT(fsync)(fd); }

/* The number is free after a failure, too: so it is on Linux. */
int close(int fd) {
  const int failed = fails("close", concerns_descriptor(fd));
  const int error = errno;
  const int result = NEXT(close)(fd);
  if (failed) errno = error;
  return failed ? -1 : result;
}

int rename(const char *from, const char *to) {
  return fails("rename", concerns_path(from)) ? -1 : NEXT(rename)(from, to);
}

int unlink(const char *path) { return fails("unlink", concerns_path(path)) ? -1 : NEXT(unlink)(path); }

int mkdir(const char *path, mode_t mode) {
  return fails("mkdir", concerns_path(path)) ? -1 : NEXT(mkdir)(path, mode);
}
