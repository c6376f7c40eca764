#include "common/core/line_writer.h"

#include <cerrno>
#include <chrono>
#include <climits>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
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
    : fd_(fd),
      wake_fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

LineWriter::~LineWriter() {
  thread_.request_stop();
  wake();
  thread_.join();
  ::close(wake_fd_);
}

void LineWriter::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_fd_, &one, sizeof one);
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
  wake();
}

bool LineWriter::flush(Duration limit) {
  constexpr Duration kLook = std::chrono::milliseconds(2);
  for (Duration waited{}; waited <= limit; waited += kLook) {
    {
      const std::lock_guard lock(mutex_);
      if (waiting_.empty() && !writing_) return true;
    }
    std::this_thread::sleep_for(kLook);
  }
  return false;
}

std::uint64_t LineWriter::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

std::string LineWriter::next() {
  const std::lock_guard lock(mutex_);
  writing_ = !waiting_.empty();
  if (waiting_.empty()) return {};
  std::string line = std::move(waiting_.front());
  waiting_.pop_front();
  if (const auto more = lost_ - std::exchange(lost_said_, lost_); more > 0)
    line = fmt::format("[{} lines are lost here: nobody read them]\n{}", more, line);
  return line;
}

void LineWriter::run(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), "log");
  while (!stop.stop_requested()) {
    if (const std::string line = next(); !line.empty()) {
      (void)writeWithin(fd_, line, kForEver, stop);
      continue;
    }
    pollfd pushed{wake_fd_, POLLIN, 0};
    ::poll(&pushed, 1, -1);
    std::uint64_t count = 0;
    [[maybe_unused]] const auto read = ::read(wake_fd_, &count, sizeof count);
  }
}

}  // namespace kiln
