#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "common/core/error.h"

namespace kiln {

/// A file that only grows. append() hands the bytes to the system, which is enough to survive a
/// killed process; a thread `record.sync` pushes them to the disk behind it (fdatasync), so that a
/// power cut costs little and a slow disk holds nobody up. Thread-compatible.
class RecordFile {
 public:
  /// Error: Storage when the file exists already or cannot be made.
  [[nodiscard]] static Result<std::unique_ptr<RecordFile>> create(const std::string& path);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  /// All of it or nothing: what was written of a failed append is taken away again. Error: Storage
  /// with the system's reason (disk full).
  [[nodiscard]] Result<void> append(std::string_view bytes);
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  RecordFile(int fd, std::string path);
  void syncLoop(std::stop_token stop);

  const int fd_;
  const std::string path_;
  std::uint64_t size_ = 0;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool dirty_ = false;  // guarded by mutex_
  std::jthread sync_;
};

/// Bytes that are free for users on the file system of `path` (a folder or file). Error: Storage.
[[nodiscard]] Result<std::uint64_t> freeDiskBytes(const std::string& path);

}  // namespace kiln
