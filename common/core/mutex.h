#pragma once

#include <pthread.h>

namespace kiln {

/// A mutex with priority inheritance: an ordinary thread that holds it while a real-time one waits
/// runs at that one's priority, so that a busy machine cannot keep the control loop out through a
/// third thread (priority inversion). For whatever device, control, mission or STOP threads share
/// with others. Standard Lockable; wait on it with std::condition_variable_any.
class Mutex {
 public:
  Mutex();
  ~Mutex();
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;
  void lock();
  [[nodiscard]] bool try_lock();
  void unlock();

 private:
  pthread_mutex_t mutex_{};
};

}  // namespace kiln
