#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "mutex.h"

namespace cellcrush::watch {

/// What is new of one job and not in the journal: the newest progress and frame. And who waits for news of it.
/// Thread-safe. Whoever publishes never waits for a watcher.
class Channel {
 public:
  /// Called on every change, from the publishing thread, under the channel's lock: must be quick and must not call
  /// back.
  using Wake = std::function<void()>;

  struct Newest {
    std::shared_ptr<const v1::Progress> progress;  ///< null before the first
    std::shared_ptr<const v1::FieldFrame> frame;   ///< null before the first
    std::uint64_t progress_count = 0;              ///< published so far
    std::uint64_t frame_count = 0;
  };

  void publish(v1::Progress progress);
  /// A frame that is no newer than the newest one is not: a worker that goes on from a checkpoint sends some again.
  void publish(v1::FieldFrame frame);
  /// The job begins again from step 0: what was published before does not count any more.
  void forget();
  /// There are new durable events in the journal.
  void announce();

  [[nodiscard]] Newest newest() const;

  /// Whether somebody waits for news.
  [[nodiscard]] bool is_watched() const;

  /// Returns the id to unsubscribe with. After unsubscribe returns, `wake` is not called again. A new frame wakes only
  /// those who want frames.
  std::uint64_t subscribe(Wake wake, bool frames);
  void unsubscribe(std::uint64_t id);

 private:
  struct Watcher {
    Wake wake;
    bool frames;
  };

  mutable Mutex mutex_;
  Newest newest_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Watcher> watchers_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t next_id_ CELLCRUSH_GUARDED_BY(mutex_) = 1;
};

/// The channels of all jobs that someone runs or watches. Thread-safe.
class Hub {
 public:
  /// The job's channel; it lives as long as someone holds it.
  std::shared_ptr<Channel> open(std::int64_t job);
  /// The same, or null when nobody holds it.
  std::shared_ptr<Channel> find(std::int64_t job);
  /// Announces to the job's channel, if there is one.
  void announce(std::int64_t job);

 private:
  Mutex mutex_;
  std::map<std::int64_t, std::weak_ptr<Channel>> channels_ CELLCRUSH_GUARDED_BY(mutex_);
  std::size_t kept_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< channels at the last time when the dead ones were removed
};

}  // namespace cellcrush::watch
