#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "error.h"
#include "mutex.h"

namespace cellcrush::rpc {

/// The memory that is held for each caller. Outlives its charges. Thread-safe.
class Accounts {
 public:
  struct Most {
    std::int64_t in_all = 0;
    std::int64_t per_caller = 0;
  };

  /// Memory held for a caller, released on destruction. One thread at a time.
  class Charge {
   public:
    Charge(Accounts& accounts, std::string caller, std::int64_t bytes)
        : accounts_(accounts), caller_(std::move(caller)), bytes_(bytes) {}
    ~Charge() { set(0); }
    Charge(const Charge&) = delete;
    Charge& operator=(const Charge&) = delete;

    /// From now on it holds that much, even beyond the limits.
    void set(std::int64_t bytes);

   private:
    Accounts& accounts_;
    std::string caller_;
    std::int64_t bytes_;
  };

  explicit Accounts(Most most) : most_(most) {}

  /// Null if the caller, or all callers, would hold too much. What is small for all, or the caller's only charge, never
  /// is.
  std::shared_ptr<Charge> take(const std::string& caller, std::int64_t bytes);

  /// `call`: called when memory was released, if `take` has returned null since the last time; quick. REQUIRES: no
  /// charge was taken yet.
  void on_release(std::function<void()> call) { on_release_.push_back(std::move(call)); }

 private:
  void change(const std::string& caller, std::int64_t by);

  const Most most_;
  std::vector<std::function<void()>> on_release_;
  Mutex mutex_;
  std::map<std::string, std::int64_t> callers_ CELLCRUSH_GUARDED_BY(mutex_);  ///< bytes by caller
  std::int64_t in_all_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  bool is_awaited_ CELLCRUSH_GUARDED_BY(mutex_) = false;
};

/// The error of a request whose bytes have no room.
ServiceError too_many_bytes(const std::string& caller);

}  // namespace cellcrush::rpc
