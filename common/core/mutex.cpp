#include "common/core/mutex.h"

#include "common/core/check.h"

namespace kiln {

Mutex::Mutex() {
  pthread_mutexattr_t attributes;
  ::pthread_mutexattr_init(&attributes);
  ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
  const int failed = ::pthread_mutex_init(&mutex_, &attributes);
  ::pthread_mutexattr_destroy(&attributes);
  KILN_CHECK(failed == 0, "the kernel has no mutexes with priority inheritance", failed);
}

Mutex::~Mutex() { ::pthread_mutex_destroy(&mutex_); }

void Mutex::lock() {
  const int failed = ::pthread_mutex_lock(&mutex_);
  KILN_CHECK(failed == 0, "a thread locked a mutex twice", failed);
}

bool Mutex::try_lock() { return ::pthread_mutex_trylock(&mutex_) == 0; }

void Mutex::unlock() { ::pthread_mutex_unlock(&mutex_); }

}  // namespace kiln
