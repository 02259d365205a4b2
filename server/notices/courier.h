#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "metrics/metrics.h"
#include "mutex.h"
#include "notices/feed.h"
#include "notices/receiver.h"
#include "store/journal.h"

namespace cellcrush::notices {

/// Brings the notices to one receiver, in order, on a thread of its own, and sends again what was not taken. The
/// journal keeps how far the receiver has come, so that the next daemon goes on from there: after a crash it may be
/// told some again, with the same ids. Thread-safe.
class Courier {
 public:
  /// Dependencies; all outlive it.
  struct Parts {
    store::Journal& journal;
    Feed::Parts feed;
    metrics::Metrics& metrics;
    Options options;
  };

  Courier(Parts parts, std::unique_ptr<Receiver> receiver);
  ~Courier() { stop(); }

  void start();
  void stop();
  /// A notice that is not in the journal. Of many that wait the oldest is dropped.
  void post(const Notice& notice);

  [[nodiscard]] std::string name() const { return receiver_->name(); }
  /// Number of the last change that the receiver has seen.
  [[nodiscard]] std::int64_t position() const { return position_; }

 private:
  using Clock = std::chrono::steady_clock;

  void work(const std::stop_token& stop);
  /// Sends all notices that the receiver has not seen. Throws ServiceError if the journal cannot be read.
  void send_all(const std::stop_token& stop);
  /// Returns once it is taken or given up; false if a stop is requested first.
  bool send(const Notice& notice, const std::stop_token& stop);
  std::optional<Notice> take_posted();
  /// Where the receiver has come to.
  std::int64_t find_position();
  /// Unless it was kept within this time.
  void keep_position(std::chrono::milliseconds after = {});

  Parts parts_;
  std::unique_ptr<Receiver> receiver_;
  std::optional<Feed> feed_;  ///< of the thread
  std::int64_t kept_ = -1;    ///< position that the journal has
  Clock::time_point last_kept_;
  std::atomic<std::int64_t> position_ = 0;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Notice> posted_ CELLCRUSH_GUARDED_BY(mutex_);
  std::jthread thread_;
};

}  // namespace cellcrush::notices
