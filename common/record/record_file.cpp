#include "common/record/record_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <pthread.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace kiln {

Result<std::unique_ptr<RecordFile>> RecordFile::create(const std::string& path) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (fd < 0) {
    return makeError(ErrorCode::Storage, "{}: cannot create the recording: {}", path,
                     std::strerror(errno));
  }
  return std::unique_ptr<RecordFile>(new RecordFile(fd, path));
}

RecordFile::RecordFile(int fd, std::string path)
    : fd_(fd), path_(std::move(path)), sync_([this](std::stop_token stop) { syncLoop(stop); }) {}

RecordFile::~RecordFile() {
  sync_.request_stop();
  changed_.notify_all();
  if (sync_.joinable()) sync_.join();
  (void)::fdatasync(fd_);
  ::close(fd_);
}

Result<void> RecordFile::append(std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(fd_, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int reason = n < 0 ? errno : ENOSPC;
      (void)!::ftruncate(fd_, static_cast<off_t>(size_));
      (void)::lseek(fd_, static_cast<off_t>(size_), SEEK_SET);
      return makeError(ErrorCode::Storage, "{}: cannot go on recording: {}", path_,
                       std::strerror(reason));
    }
    done += static_cast<std::size_t>(n);
  }
  size_ += bytes.size();
  {
    const std::lock_guard lock(mutex_);
    dirty_ = true;
  }
  changed_.notify_one();
  return {};
}

void RecordFile::syncLoop(std::stop_token stop) {
  pthread_setname_np(pthread_self(), "record.sync");
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return dirty_; })) {
    dirty_ = false;
    lock.unlock();
    (void)::fdatasync(fd_);
    lock.lock();
  }
}

Result<std::uint64_t> freeDiskBytes(const std::string& path) {
  struct statvfs disk = {};
  if (::statvfs(path.c_str(), &disk) != 0) {
    return makeError(ErrorCode::Storage, "{}: cannot ask for the free space: {}", path,
                     std::strerror(errno));
  }
  return static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
}

}  // namespace kiln
