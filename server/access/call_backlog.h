#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_map>

#include "mutex.h"

namespace cellcrush::access {

/// The calls over gRPC that have come and not ended. gRPC 1.51 takes 12 to 20 kB for each, and reads them faster than
/// it begins and ends them. Here the connections share the places: each may have one, and as many as are left free, so
/// that some are left for others. Thread-safe.
class CallBacklog {
 public:
  /// Identifies a connection as long as it is open.
  using Key = const void*;

  explicit CallBacklog(std::size_t most) : most_(most) {}

  /// `alarm`: called from within `admit` and `refuse` with gRPC's name of a connection that makes calls in spite of
  /// many refusals; quick. REQUIRES: no call has come.
  void on_flood(std::function<void(const std::string& connection)> alarm) { on_flood_ = std::move(alarm); }

  /// A call has come. False if it is one too many of its connection.
  [[nodiscard]] bool admit(Key connection);

  /// An admitted call was queued; then it begins; then it ends. One that is cancelled early may never be queued.
  void queue();
  void begin(Key connection, const std::string& name);
  void end(Key connection);

  /// One that has begun is one too many all the same.
  void refuse(Key connection);

  /// Called about once a second: forgets refusals.
  void look();

 private:
  struct Connection {
    std::string name;          ///< empty until a call begins
    std::size_t coming = 0;    ///< admitted and not begun
    std::size_t begun = 0;     ///< and not ended
    std::size_t refusals = 0;  ///< since the last look
    bool is_cut = false;       ///< its flood was told
  };

  /// Counts a refusal. Returns the name of the connection if they are a flood, otherwise nothing.
  std::string count_refusal(Connection& of) CELLCRUSH_REQUIRES(mutex_);

  const std::size_t most_;
  std::function<void(const std::string& connection)> on_flood_;
  Mutex mutex_;
  std::size_t queued_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< and not begun
  std::size_t coming_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< of all connections, the queued ones too
  std::size_t begun_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::unordered_map<Key, Connection> connections_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::access
