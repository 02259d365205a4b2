#pragma once

#include <mutex>

/// Which mutex guards what. clang checks it (the test ThreadSafety); g++ skips it.
#if defined(__clang__)
#define CELLCRUSH_THREAD_SAFETY(attribute) __attribute__((attribute))
#else
#define CELLCRUSH_THREAD_SAFETY(attribute)
#endif

/// Behind a field: it is read and written with the mutex held only.
#define CELLCRUSH_GUARDED_BY(mutex) CELLCRUSH_THREAD_SAFETY(guarded_by(mutex))
/// Behind a function or the parameters of a lambda: the caller holds the mutex.
#define CELLCRUSH_REQUIRES(mutex) CELLCRUSH_THREAD_SAFETY(requires_capability(mutex))

namespace cellcrush {

/// A std::mutex that clang knows.
class CELLCRUSH_THREAD_SAFETY(capability("mutex")) Mutex {
 public:
  void lock() CELLCRUSH_THREAD_SAFETY(acquire_capability()) { mutex_.lock(); }
  void unlock() CELLCRUSH_THREAD_SAFETY(release_capability()) { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

/// Holds a mutex while it lives, but between `unlock` and `lock`. A std::condition_variable_any waits with it.
class CELLCRUSH_THREAD_SAFETY(scoped_lockable) MutexLock {
 public:
  explicit MutexLock(Mutex& mutex) CELLCRUSH_THREAD_SAFETY(acquire_capability(mutex)) : lock_(mutex) {}
  ~MutexLock() CELLCRUSH_THREAD_SAFETY(release_capability()) = default;
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

  void lock() CELLCRUSH_THREAD_SAFETY(acquire_capability()) { lock_.lock(); }
  void unlock() CELLCRUSH_THREAD_SAFETY(release_capability()) { lock_.unlock(); }

 private:
  std::unique_lock<Mutex> lock_;
};

}  // namespace cellcrush
