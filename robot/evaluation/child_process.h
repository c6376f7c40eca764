#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "common/core/error.h"
#include "common/core/stamp.h"

namespace kiln {

/// A program started by us and ended by us. The destructor asks it to stop (SIGTERM), waits up to 3
/// s, then kills it. Its standard error goes to `log_path`.
class ChildProcess {
 public:
  [[nodiscard]] static Result<ChildProcess> start(const std::vector<std::string>& argv,
                                                  const std::string& log_path);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  /// Exit status (128 + signal if killed), or nullopt if it still runs after `limit`.
  [[nodiscard]] std::optional<int> wait(Duration limit);
  [[nodiscard]] bool running() { return !wait(Duration::zero()).has_value(); }
  void signal(int number) const;
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// CPU seconds (user + system) used so far, from /proc; nullopt once it has ended.
  [[nodiscard]] std::optional<double> cpuSeconds() const;

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  void end();

  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Path of a program that was built beside the running one.
[[nodiscard]] std::string siblingProgram(const std::string& name);

/// A fresh private folder for sockets and reports, removed with everything in it by the destructor.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The last `lines` lines of a text file, for error messages.
[[nodiscard]] std::string tailOf(const std::string& path, int lines);

}  // namespace kiln
