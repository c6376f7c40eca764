#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/record/record_index.h"

namespace kiln {

Result<std::shared_ptr<const RandomFile>> RandomFile::open(const std::string& path) {
  // O_NONBLOCK: a FIFO is refused at once, not waited for.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) {
    return makeError(ErrorCode::NotFound, "{}: cannot open the recording: {}", path,
                     std::strerror(errno));
  }
  struct stat status = {};
  if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(fd);
    return makeError(ErrorCode::InvalidInput, "{}: not a file; give a .mcap recording", path);
  }
  return std::shared_ptr<const RandomFile>(
      new RandomFile(fd, path, static_cast<std::uint64_t>(status.st_size)));
}

RandomFile::RandomFile(int fd, std::string path, std::uint64_t size)
    : fd_(fd), path_(std::move(path)), size_(size) {}
RandomFile::~RandomFile() { ::close(fd_); }

Result<std::string> RandomFile::read(std::uint64_t offset, std::uint64_t size) const {
  if (offset > size_ || size > size_ - offset) {
    return makeError(ErrorCode::Truncated, "{}: {} bytes at {} are beyond its end ({})", path_,
                     size, offset, size_);
  }
  std::string out(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t n =
        ::pread(fd_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      return makeError(ErrorCode::Storage, "{}: cannot read at {}: {}", path_, offset + done,
                       n < 0 ? std::strerror(errno) : "the file has become shorter");
    }
    done += static_cast<std::size_t>(n);
  }
  return out;
}

}  // namespace kiln
