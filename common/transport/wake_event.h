#pragma once

namespace kiln {

/// Wakes a thread that polls its file descriptor. notify() from any thread; clear() by the polling
/// one.
class WakeEvent {
 public:
  WakeEvent();
  ~WakeEvent();
  WakeEvent(const WakeEvent&) = delete;
  WakeEvent& operator=(const WakeEvent&) = delete;
  void notify();
  void clear();
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_;
};

}  // namespace kiln
