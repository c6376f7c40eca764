#include "common/core/regular_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace kiln {
namespace {

struct Descriptor {
  explicit Descriptor(int number) : fd(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
  int fd;
};

Error cannotRead(const std::string& path) {
  return {errno == ENOENT || errno == ENOTDIR ? ErrorCode::NotFound : ErrorCode::Storage,
          fmt::format("{}: cannot be read: {}; check path and permissions", path,
                      std::strerror(errno))};
}

}  // namespace

Result<std::string> readRegularFile(const std::string& path, std::uint64_t most_bytes) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.fd < 0) return tl::make_unexpected(cannotRead(path));
  struct stat status = {};
  if (fstat(file.fd, &status) != 0) return tl::make_unexpected(cannotRead(path));
  if (!S_ISREG(status.st_mode))
    return makeError(ErrorCode::InvalidInput, "{}: not a regular file; give one", path);
  std::string text(4096, '\0');
  std::size_t size = 0;  // counted: the files of /proc and /sys say 0, others may grow meanwhile
  for (;;) {
    const ssize_t got = read(file.fd, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return tl::make_unexpected(cannotRead(path));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (size > most_bytes)
      return makeError(ErrorCode::InvalidInput, "{}: longer than {} bytes; this is no such file",
                       path, most_bytes);
    if (size == text.size()) text.resize(2 * text.size());
  }
  text.resize(size);
  return text;
}

}  // namespace kiln
