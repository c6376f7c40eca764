#include "robot/world_model/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace kiln {
namespace {

/// Closes on every way out.
struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

tl::unexpected<Error> storageError(const std::string& path, const char* what) {
  return makeError(ErrorCode::Storage, "cannot {} {}: {}; free the disk or check the folder", what,
                   path, std::strerror(errno));
}

Result<void> writeAll(const Descriptor& file, const std::string& path, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file.fd, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return storageError(path, "write");
    done += static_cast<std::size_t>(n);
  }
  return {};
}

Result<void> syncFolder(const std::string& path) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  const Descriptor handle{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (handle.fd < 0 || ::fsync(handle.fd) != 0) return storageError(folder.string(), "sync folder");
  return {};
}

}  // namespace

Result<void> writeFileAtomically(const std::string& path, const std::string& text,
                                 Durability durability) {
  const std::string temporary = path + ".tmp";
  {
    const Descriptor file{
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)};
    if (file.fd < 0) return storageError(temporary, "create");
    if (auto written = writeAll(file, temporary, text); !written) return written;
    if (durability == Durability::PowerLoss && ::fsync(file.fd) != 0)
      return storageError(temporary, "sync");
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0) return storageError(path, "replace");
  if (durability == Durability::PowerLoss) return syncFolder(path);
  return {};
}

Result<std::string> readWholeFile(const std::string& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0 && errno == ENOENT)
    return makeError(ErrorCode::NotFound, "there is no file {}", path);
  if (file.fd < 0) return storageError(path, "open");
  std::string out;
  char buffer[4096];
  for (;;) {
    const ssize_t n = ::read(file.fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return storageError(path, "read");
    if (n == 0) return out;
    out.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace kiln
