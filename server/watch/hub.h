#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "mutex.h"
#include "store/journal_reader.h"
#include "watch/sent_frame.h"
#include "watch/sent_message.h"

namespace cellcrush::watch {

/// The latest events of the jobs that are watched. Each is read and encoded once, by the first watcher that asks for
/// it, and is shared. Memory is bounded: at most kMostJobs times kMostBytes. Thread-safe.
class RecentEvents {
 public:
  /// A state or sample.
  struct Entry {
    std::int64_t sequence = 0;
    bool is_sample = false;
    bool begins_again = false;  ///< the job restarts from step 0 with this event
    bool is_last = false;       ///< of the job
    std::string bytes = {};     ///< of the JobEvent, with its words
  };
  using Event = std::shared_ptr<const Entry>;

  static constexpr int kAtOnce = 256;  ///< events
  static constexpr std::size_t kMostJobs = 64;
  static constexpr std::size_t kMostBytes = 512 * 1024;  ///< of a job, encoded

  /// Up to kAtOnce events after event `after`, in order; none only if there are none. `stamp`: Channel::stamp, from
  /// before the call: the journal has no other events as long as it is the same. Throws ServiceError: not_found if
  /// there is no such job, and the errors of JournalReader::events.
  std::vector<Event> after(store::JournalReader& journal, std::int64_t job, std::int64_t after, std::uint64_t stamp);

  /// Whether it is known that `after` would return none.
  bool ends_with(std::int64_t job, std::int64_t after, std::uint64_t stamp);

  /// Drops the events of a job, whose last one has changed.
  void forget(std::int64_t job);

  /// How often the journal was read.
  [[nodiscard]] std::int64_t reads() const { return reads_; }

 private:
  /// Successive events of a job.
  struct Window {
    Mutex mutex;
    std::int64_t before CELLCRUSH_GUARDED_BY(mutex) = 0;  ///< number of the event before the first
    std::int64_t last CELLCRUSH_GUARDED_BY(mutex) = 0;    ///< number of the last event; `before` if there is none
    std::deque<Event> events CELLCRUSH_GUARDED_BY(mutex);
    std::size_t bytes CELLCRUSH_GUARDED_BY(mutex) = 0;
    std::optional<std::uint64_t> end_stamp CELLCRUSH_GUARDED_BY(mutex);  ///< at which nothing followed the last one
    std::atomic<std::uint64_t> turn = 0;                                 ///< when it was last used
  };
  std::shared_ptr<Window> window_of(std::int64_t job);
  std::vector<Event> read(store::JournalReader& journal, std::int64_t job, std::int64_t after);

  Mutex mutex_;
  std::map<std::int64_t, std::shared_ptr<Window>> windows_ CELLCRUSH_GUARDED_BY(mutex_);  ///< by job
  std::uint64_t turn_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::atomic<std::int64_t> reads_ = 0;
};

/// A mesh that any number of watchers are sent. Thread-safe.
class PublishedMesh {
 public:
  explicit PublishedMesh(v1::Mesh mesh) : mesh_(std::move(mesh)) {}

  [[nodiscard]] const v1::Mesh& mesh() const { return mesh_; }
  /// Of type MeshChunk.
  [[nodiscard]] const std::vector<SharedBytes>& parts() const {
    return parts_.get([this] { return chunks_of(mesh_); });
  }

 private:
  v1::Mesh mesh_;
  SharedParts parts_;
};

/// A frame that any number of watchers are sent, as numbers or packed. Thread-safe.
class PublishedFrame {
 public:
  /// `mesh` has the positions before loading; null: packed displacements are positions.
  PublishedFrame(v1::FieldFrame frame, std::shared_ptr<const PublishedMesh> mesh)
      : numbers_(std::move(frame)), mesh_(std::move(mesh)) {}

  [[nodiscard]] int index() const { return numbers_.index(); }
  [[nodiscard]] const v1::FieldFrame& numbers() const { return numbers_; }
  /// Of type FrameChunk.
  [[nodiscard]] const std::vector<SharedBytes>& parts(v1::FieldFrame::Encoding encoding) const {
    if (encoding != v1::FieldFrame::PACKED) return parts_.get([this] { return chunks_of(numbers_); });
    return packed_.get([this] { return chunks_of(pack(numbers_, mesh_ ? &mesh_->mesh() : nullptr)); });
  }

 private:
  v1::FieldFrame numbers_;
  std::shared_ptr<const PublishedMesh> mesh_;
  SharedParts parts_;
  SharedParts packed_;
};

/// The newest progress and frame of a running job and its place, which are not in the journal, its mesh, and the
/// watchers of the job.
/// Thread-safe. Publishers never wait for watchers.
class Channel {
 public:
  /// Called on every change, on the publishing thread and under the channel's lock: must be quick and must not call
  /// back.
  using Wake = std::function<void()>;

  struct Newest {
    std::shared_ptr<const PublishedMesh> mesh;     ///< null before a worker has built it
    std::shared_ptr<const v1::Progress> progress;  ///< null before the first
    std::shared_ptr<const PublishedFrame> frame;   ///< null before the first
    std::string place;                             ///< where the executor has the job (Job.place); empty: nowhere
    std::uint64_t progress_count = 0;              ///< published so far
    std::uint64_t frame_count = 0;
  };

  explicit Channel(std::uint64_t stamp) : stamp_(stamp) {}

  void publish(v1::Mesh mesh);
  void publish(v1::Progress progress);
  /// Ignores a frame that is not newer than the newest: a worker that resumes from a checkpoint resends some.
  void publish(v1::FieldFrame frame);
  /// Wakes no watcher: a place is part of snapshots only.
  void set_place(std::string place);
  /// The job restarts from step 0: drops what was published.
  void forget();
  /// Announces new durable events in the journal; `stamp` is greater than any before.
  void announce(std::uint64_t stamp);

  /// Stamp of the last announcement: as long as it is the same, the journal has no new events of the job.
  [[nodiscard]] std::uint64_t stamp() const;

  [[nodiscard]] Newest newest() const;

  /// Whether the job has watchers.
  [[nodiscard]] bool is_watched() const;

  /// Returns the id for unsubscribing. Once unsubscribe returns, `wake` is not called again. A new frame wakes only
  /// watchers that want frames.
  std::uint64_t subscribe(Wake wake, bool frames);
  void unsubscribe(std::uint64_t id);

 private:
  struct Watcher {
    Wake wake;
    bool frames;
  };

  mutable Mutex mutex_;
  Newest newest_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t stamp_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Watcher> watchers_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t next_id_ CELLCRUSH_GUARDED_BY(mutex_) = 1;
};

/// The channels of all jobs that somebody runs or watches. Thread-safe.
class Hub {
 public:
  /// The job's channel, which lives as long as somebody holds it.
  std::shared_ptr<Channel> open(std::int64_t job);
  /// The same, or null if nobody holds it.
  std::shared_ptr<Channel> find(std::int64_t job);
  /// All channels that somebody holds, by job.
  std::vector<std::pair<std::int64_t, std::shared_ptr<Channel>>> channels();
  /// Announces to the job's channel, if there is one, and to those who watch all jobs.
  void announce(std::int64_t job);

  /// Counts the announcements of all jobs.
  [[nodiscard]] std::uint64_t stamp() const { return stamp_; }

  RecentEvents& recent() { return recent_; }

  /// Has `wake` called whenever a job has new durable events. Works like those of Channel.
  std::uint64_t subscribe(Channel::Wake wake);
  void unsubscribe(std::uint64_t id);

 private:
  RecentEvents recent_;
  std::atomic<std::uint64_t> stamp_ = 0;
  Mutex mutex_;
  std::map<std::int64_t, std::weak_ptr<Channel>> channels_ CELLCRUSH_GUARDED_BY(mutex_);
  std::size_t kept_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< channels when expired ones were last removed
  Mutex watchers_mutex_;
  std::map<std::uint64_t, Channel::Wake> watchers_ CELLCRUSH_GUARDED_BY(watchers_mutex_);
  std::uint64_t next_id_ CELLCRUSH_GUARDED_BY(watchers_mutex_) = 1;
};

}  // namespace cellcrush::watch
