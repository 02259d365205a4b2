#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <optional>

#include "cellcrush/v1/event.pb.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::watch {

/// One watcher's position in the events of a job, each of which is a JobEvent. It reads them by sequence number, from
/// RecentEvents, so that a slow watcher delays nobody and costs no memory. Not thread-safe.
class WatchCursor {
 public:
  /// What to send beside states, samples and progress.
  struct Wanted {
    bool frames = false;
    bool mesh = true;
    v1::FieldFrame::Encoding encoding = v1::FieldFrame::NUMBERS;
  };

  /// Events up to `after` are not sent again. Throws ServiceError: invalid for a negative `after`, out_of_range if the
  /// job has no such event yet, not_found if there is no such job.
  WatchCursor(store::JournalReader& journal, Hub& hub, std::int64_t job, std::int64_t after, Wanted wanted);

  /// The next message: a snapshot, then states and samples in order, interleaved with the mesh and the newest progress
  /// and frame.
  /// Nothing if there is none now. Throws ServiceError: not_found if the job was deleted meanwhile, or if the journal
  /// cannot be read.
  std::optional<SentMessage> next();

  /// Whether next has a message without reading the journal.
  [[nodiscard]] bool has_more() const { return !events_.empty() || !parts_.empty() || !mesh_parts_.empty(); }

  /// Whether next has nothing before something changes; false if only the journal can tell.
  [[nodiscard]] bool is_quiet() const;

  /// Whether the job's last event was sent, and next has nothing more.
  [[nodiscard]] bool ended() const { return ended_ && snapshot_sent_ && mesh_parts_.empty(); }

  /// A bookmark: everything up to its sequence number was sent.
  [[nodiscard]] SentMessage bookmark() const;

  /// Sequence number of the last state or sample sent.
  [[nodiscard]] std::int64_t sequence() const { return after_; }

 private:
  SentMessage snapshot();
  std::optional<SentMessage> mesh_part();
  void queue_mesh();
  std::optional<SentMessage> transient();
  void queue_frame(const PublishedFrame& frame);
  SentMessage frame_part();
  /// An event of which this field is the next of the parts.
  SentMessage part_of(int field, std::list<SharedBytes>& parts, std::string after = "") const;

  store::JournalReader& journal_;
  RecentEvents& recent_;
  std::int64_t job_;
  std::shared_ptr<const Channel> channel_;
  std::int64_t after_;  ///< sequence number of the last state or sample sent
  Wanted wanted_;
  bool snapshot_sent_ = false;
  bool ended_ = false;
  // Lists, as an empty one takes no memory: a watch of a large sweep has a cursor for each job.
  std::list<RecentEvents::Event> events_;  ///< read, not sent yet
  std::list<SharedBytes> parts_;           ///< of the frame being sent
  int skipped_ = 0;                        ///< frames before that one
  std::list<SharedBytes> mesh_parts_;
  bool mesh_queued_ = false;
  bool mesh_looked_up_ = false;       ///< in the journal, for a job whose mesh was built before the watch
  std::uint64_t progress_given_ = 0;  ///< count of the channel's progress when last sent
  std::uint64_t frames_given_ = 0;
  std::optional<int> last_frame_;  ///< index of the last frame sent
};

}  // namespace cellcrush::watch
