#include "robot/app/instance_lock.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace kiln {

Result<InstanceLock> InstanceLock::acquire(const std::string& folder) {
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  const std::string path = folder + "/kiln-robotd.lock";
  const int fd = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (fd < 0) {
    return makeError(ErrorCode::Storage,
                     "cannot write in the state folder {}: {}; choose another with --state-dir",
                     folder, std::strerror(errno));
  }
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    close(fd);
    std::ifstream in(path);
    std::string pid = "unknown";
    in >> pid;
    return makeError(ErrorCode::Refused,
                     "another kiln-robotd (process {}) already runs this robot from {}; end it "
                     "first, or give this one "
                     "a --state-dir and robot of its own",
                     pid, folder);
  }
  const std::string pid = fmt::format("{}\n", getpid());
  if (ftruncate(fd, 0) != 0 || write(fd, pid.data(), pid.size()) < 0) {
    close(fd);
    return makeError(ErrorCode::Storage,
                     "cannot write {}: {}; free some space or choose another --state-dir", path,
                     std::strerror(errno));
  }
  return InstanceLock(fd);
}

InstanceLock::InstanceLock(InstanceLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

InstanceLock::~InstanceLock() {
  if (fd_ >= 0) close(fd_);
}

}  // namespace kiln
