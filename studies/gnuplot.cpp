#include "studies/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "studies/figure.h"
#include "studies/file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// The exit status, or -1 when there is no such program.
int run(std::vector<std::string> arguments, const fs::path& folder) {
  FileActions actions;
  posix_spawn_file_actions_addchdir_np(actions.get(), folder.c_str());
  posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, argv[0], actions.get(), nullptr, argv.data(), environ) != 0) return -1;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return 127;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Drawing draw(const fs::path& script, const fs::path& figure, const std::string& format) {
  const fs::path part = name_beside(figure);
  const std::string settings = fmt::format("format = {}; figure = {}", gnuplot_quoted(format),
                                           gnuplot_quoted(part.filename().string()));
  const fs::path folder = script.has_parent_path() ? script.parent_path() : ".";
  // "./": a script whose name begins with a dash is no option.
  const int status = run({"gnuplot", "-e", settings, "./" + script.filename().string()}, folder);
  std::error_code error;
  if (status == 0 && fs::file_size(part, error) > 0 && !error) {
    put_in_place(part, figure);
    return {true, {}};
  }
  fs::remove(part, error);
  if (status == -1) {
    return {false,
            fmt::format("{}: not drawn: gnuplot is not installed (Debian: apt-get install gnuplot-nox); "
                        "later, run gnuplot on {}",
                        figure.string(), script.string())};
  }
  return {false, fmt::format("{}: not drawn: gnuplot ended with status {}; run it on {} to see why",
                             figure.string(), status, script.string())};
}

}  // namespace flyball
