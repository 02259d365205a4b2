#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "cellcrush/v1/event.pb.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::watch {

/// One watcher's place in the events of a job: what it is sent next. It reads from the journal by sequence number, so a
/// slow watcher holds up nobody and costs no memory. Not thread-safe.
class WatchCursor {
 public:
  /// What is sent beside states, samples and progress.
  struct Wanted {
    bool frames = false;
    bool mesh = true;  ///< in the snapshot
  };

  /// Events up to `after` are not sent again. Throws ServiceError: invalid when `after` is negative, out_of_range when
  /// the job has no such event yet, not_found when there is no such job.
  WatchCursor(store::JournalReader& journal, std::int64_t job, std::shared_ptr<const Channel> channel,
              std::int64_t after, Wanted wanted);

  /// The next message: a snapshot, then states and samples in order, with the newest progress and frame between them.
  /// Nothing when there is none now. Throws ServiceError: not_found when the job was deleted meanwhile, or when the
  /// journal cannot be read.
  std::optional<v1::JobEvent> next();

  /// Whether next has something without a look into the journal.
  [[nodiscard]] bool has_more() const { return !events_.empty() || !parts_.empty(); }

  /// Whether the job's last event has been given.
  [[nodiscard]] bool ended() const { return ended_ && snapshot_sent_; }

  /// A sign of life: everything up to its sequence number has been given.
  [[nodiscard]] v1::JobEvent bookmark() const;

  /// Number of the last state or sample that was given.
  [[nodiscard]] std::int64_t sequence() const { return after_; }

 private:
  v1::JobEvent snapshot();
  std::optional<v1::JobEvent> transient();
  void queue_frame(const v1::FieldFrame& frame);

  store::JournalReader& journal_;
  std::int64_t job_;
  std::shared_ptr<const Channel> channel_;
  std::int64_t after_;  ///< sequence number of the last state or sample given
  Wanted wanted_;
  bool snapshot_sent_ = false;
  bool ended_ = false;
  std::deque<v1::JobEvent> events_;   ///< read from the journal, not given yet
  std::deque<v1::FrameChunk> parts_;  ///< of the frame that is being given
  std::uint64_t progress_given_ = 0;  ///< count of the channel's progress at the last one given
  std::uint64_t frames_given_ = 0;
  std::optional<int> last_frame_;  ///< index of the last frame given
};

}  // namespace cellcrush::watch
