#include "common/core/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace kiln {
namespace {

bool writeAll(int fd, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = write(fd, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    written += static_cast<std::size_t>(n);
  }
  return true;
}

void syncFolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  fsync(fd);
  close(fd);
}

/// What `named` stands for when it is a link.
Result<std::string> fileToReplace(const std::string& named) {
  std::error_code ec;
  const auto found = std::filesystem::status(named, ec);
  if (!std::filesystem::exists(found)) return named;
  if (!std::filesystem::is_regular_file(found))
    return makeError(ErrorCode::Storage, "cannot write {}: not a regular file; name another",
                     named);
  if (!std::filesystem::is_symlink(std::filesystem::symlink_status(named, ec))) return named;
  const auto target = std::filesystem::canonical(named, ec);
  return ec ? named : target.string();
}

}  // namespace

Result<void> writeFileAtomically(const std::string& named, const std::string& text, bool durable) {
  const auto replaced = fileToReplace(named);
  if (!replaced) return tl::make_unexpected(replaced.error());
  const std::string& path = *replaced;
  const std::string temporary = path + ".tmp";
  const int fd = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) {
    return makeError(ErrorCode::Storage,
                     "cannot write {}: {}; check the folder and its permissions", path,
                     std::strerror(errno));
  }
  bool ok = writeAll(fd, text) && (!durable || fsync(fd) == 0);
  int reason = errno;
  close(fd);
  if (ok && std::rename(temporary.c_str(), path.c_str()) != 0) {
    ok = false;
    reason = errno;
  }
  if (!ok) {
    unlink(temporary.c_str());
    return makeError(ErrorCode::Storage,
                     "cannot write {}: {}; free some space or choose another place", path,
                     std::strerror(reason));
  }
  if (durable) syncFolderOf(path);
  return {};
}

}  // namespace kiln
