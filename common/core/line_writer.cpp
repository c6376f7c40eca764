#include "common/core/line_writer.h"

#include <cerrno>
#include <chrono>
#include <climits>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace kiln {
namespace {

constexpr std::size_t kMostWaiting = 1000;
constexpr std::chrono::milliseconds kSlice{50};
constexpr Duration kForEver = std::chrono::hours(24 * 365);

/// A pipe that polls writable takes PIPE_BUF bytes without blocking; a socket is told not to.
ssize_t writeSome(int fd, std::string_view bytes) {
  const std::size_t size = std::min<std::size_t>(bytes.size(), PIPE_BUF);
  const ssize_t sent = ::send(fd, bytes.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL);
  return sent < 0 && errno == ENOTSOCK ? ::write(fd, bytes.data(), size) : sent;
}

}  // namespace

bool writeWithin(int fd, std::string_view bytes, Duration limit, const std::stop_token& stop) {
  Duration waited{};
  while (!bytes.empty()) {
    if (stop.stop_requested() || waited >= limit) return false;
    pollfd ready{fd, POLLOUT, 0};
    const int n = ::poll(&ready, 1, static_cast<int>(kSlice.count()));
    if (n == 0) waited += kSlice;
    if (n <= 0) continue;
    const ssize_t written = writeSome(fd, bytes);
    if (written < 0 && errno != EINTR && errno != EAGAIN) return false;  // nobody will ever read it
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

LineWriter::LineWriter(int fd)
    : fd_(fd), thread_([this](const std::stop_token& stop) { run(stop); }) {}

LineWriter::~LineWriter() {
  thread_.request_stop();
  changed_.notify_all();
}

void LineWriter::push(std::string line) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostWaiting) {
      waiting_.pop_front();
      ++lost_;
    }
    waiting_.push_back(std::move(line));
  }
  changed_.notify_all();
}

bool LineWriter::flush(Duration limit) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, limit, [&] { return waiting_.empty() && !writing_; });
}

std::uint64_t LineWriter::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

std::string LineWriter::next(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  writing_ = false;
  if (waiting_.empty()) changed_.notify_all();
  changed_.wait(lock, [&] { return stop.stop_requested() || !waiting_.empty(); });
  if (waiting_.empty()) return {};
  writing_ = true;
  std::string line = std::move(waiting_.front());
  waiting_.pop_front();
  if (const auto more = lost_ - std::exchange(lost_said_, lost_); more > 0)
    line = fmt::format("[{} lines are lost here: nobody read them]\n{}", more, line);
  return line;
}

void LineWriter::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) (void)writeWithin(fd_, next(stop), kForEver, stop);
}

}  // namespace kiln
