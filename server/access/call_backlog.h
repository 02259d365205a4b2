#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "mutex.h"

namespace cellcrush::access {

/// The calls over gRPC that have come and not ended. gRPC 1.51 takes 12 to 20 kB for each, reads them faster than it
/// begins and ends them, waits for a message without limit, and no longer counts those that their client has reset.
/// Here the connections share the places: each may have as many as are left free, so that some are left for others.
/// Thread-safe.
class CallBacklog {
 public:
  /// Identifies a connection as long as it is open.
  using Key = const void*;

  explicit CallBacklog(std::size_t most) : most_(most) {}

  /// Both are called from within `admit`, and are quick. REQUIRES: no call has come.
  struct Alarms {
    /// This connection, by gRPC's name, makes calls in spite of many refusals.
    std::function<void(const std::string& connection)> flood;
    /// Many calls have not begun, or some for long: they may have ended, unseen. Asks for `settle`.
    std::function<void()> crowd;
  };
  void set_alarms(Alarms alarms) { alarms_ = std::move(alarms); }

  /// A call has come. False if it is one too many of its connection.
  [[nodiscard]] bool admit(Key connection);

  /// An admitted call was read and queued; then it begins; then it ends.
  void queue();
  void begin(Key connection, const std::string& name);
  void end(Key connection);

  /// Called about once a second: looks for calls whose messages do not end, which gRPC keeps, up to 4 MiB each.
  void look();

  /// `streams`: those that are open in truth, by connection. Returns the connections with most calls that have not
  /// begun, while all together have too many. For calls that wait long, asks twice.
  std::vector<std::string> settle(const std::map<std::string, std::size_t>& streams);

 private:
  struct Connection {
    std::string name;        ///< empty until a call begins
    std::size_t coming = 0;  ///< admitted and not begun, or ended before that since `settle`
    std::size_t begun = 0;   ///< and not ended
    std::size_t refusals = 0;  ///< since none was queued
  };

  /// So many calls that have not begun are suspicious: it takes a call a moment.
  [[nodiscard]] std::size_t crowd() const { return most_ / 4; }
  /// So many whose messages take long hold too many bytes.
  [[nodiscard]] std::size_t slow_crowd() const { return most_ / 100; }
  /// Whether `crowd` is to be called.
  bool find_crowd() CELLCRUSH_REQUIRES(mutex_);

  const std::size_t most_;
  Alarms alarms_;
  Mutex mutex_;
  std::size_t queued_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::size_t coming_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< of all connections, the queued ones too
  std::size_t begun_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::size_t refusals_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  bool is_settling_ CELLCRUSH_GUARDED_BY(mutex_) = false;  ///< `crowd` was called
  /// Calls that had come before the last look and were not queued since.
  std::size_t slow_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::size_t before_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< calls that had come and were not queued, at the last look
  std::size_t queued_since_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::chrono::steady_clock::time_point last_look_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::string, std::size_t> held_ CELLCRUSH_GUARDED_BY(mutex_);  ///< found by `settle`, for slow calls
  std::chrono::steady_clock::time_point may_settle_ CELLCRUSH_GUARDED_BY(mutex_);
  std::unordered_map<Key, Connection> connections_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::access
