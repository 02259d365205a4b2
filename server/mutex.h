#pragma once

#include <mutex>

/// Declares which mutex guards what. clang checks it (test ThreadSafety); g++ ignores it.
#if defined(__clang__)
#define CELLCRUSH_THREAD_SAFETY(attribute) __attribute__((attribute))
#else
#define CELLCRUSH_THREAD_SAFETY(attribute)
#endif

/// After a field: access requires the mutex.
#define CELLCRUSH_GUARDED_BY(mutex) CELLCRUSH_THREAD_SAFETY(guarded_by(mutex))
/// After a function or the parameters of a lambda: the caller holds the mutex.
#define CELLCRUSH_REQUIRES(mutex) CELLCRUSH_THREAD_SAFETY(requires_capability(mutex))

namespace cellcrush {

/// A std::mutex with clang's annotations.
class CELLCRUSH_THREAD_SAFETY(capability("mutex")) Mutex {
 public:
  void lock() CELLCRUSH_THREAD_SAFETY(acquire_capability()) { mutex_.lock(); }
  void unlock() CELLCRUSH_THREAD_SAFETY(release_capability()) { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

/// Holds a mutex while it lives, except between `unlock` and `lock`. Works with std::condition_variable_any.
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
