#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "mutex.h"

namespace cellcrush::rpc {

/// Counts the open streams, in total and by caller, and the bytes of their unread messages. Outlives its permits.
/// Thread-safe.
class StreamLimits {
 public:
  struct Most {
    int in_all = 0;
    int per_caller = 0;
    std::int64_t bytes = 0;                ///< of unread messages; of one caller half as many
    const char* what = "streams";          ///< in messages
    const char* option = "--max-streams";  ///< that sets the limit, with "-per-caller" the other; empty: none does
  };

  /// The place of a stream, released on destruction. One thread at a time.
  class Permit {
   public:
    Permit() = default;
    Permit(StreamLimits& limits, std::string caller) : limits_(&limits), caller_(std::move(caller)) {}
    ~Permit();
    Permit(Permit&& other) noexcept
        : limits_(std::exchange(other.limits_, nullptr)),
          caller_(std::move(other.caller_)),
          bytes_(std::exchange(other.bytes_, 0)) {}
    Permit& operator=(Permit&&) = delete;

    /// Sets the bytes that the stream holds. Throws ServiceError (exhausted) if the streams of the caller, or of all
    /// callers, would hold too many; it then holds none.
    void hold(std::size_t bytes);
    [[nodiscard]] std::int64_t bytes() const { return bytes_; }

   private:
    StreamLimits* limits_ = nullptr;
    std::string caller_;
    std::int64_t bytes_ = 0;
  };

  explicit StreamLimits(Most most) : most_(most) {}

  /// Throws ServiceError (exhausted) if this would be one too many; the message names the limit.
  Permit admit(const std::string& caller);

  [[nodiscard]] std::size_t count() const;

  /// Whether others may soon be refused: seven eighths of the places or bytes are taken.
  [[nodiscard]] bool is_short() const;

 private:
  struct Held {
    int count = 0;
    std::int64_t bytes = 0;
  };

  const Most most_;
  mutable Mutex mutex_;
  std::map<std::string, Held> callers_ CELLCRUSH_GUARDED_BY(mutex_);
  Held all_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::rpc
