#include "watch/watch_cursor.h"

#include <algorithm>
#include <utility>

#include "error.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"
#include "watch/sent_message.h"

namespace cellcrush::watch {
namespace {

store::StoredJob find_job(store::JournalReader& journal, std::int64_t job) {
  auto found = journal.find_job(job);
  if (!found) throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  if (found->is_damaged) throw store::unreadable_entry(job);
  return *std::move(found);
}

}  // namespace

WatchCursor::WatchCursor(store::JournalReader& journal, Hub& hub, std::int64_t job, std::int64_t after, Wanted wanted)
    : journal_(journal), recent_(hub.recent()), job_(job), channel_(hub.open(job)), after_(after), wanted_(wanted) {
  const auto stored = find_job(journal_, job_);
  if (after < 0) {
    throw ServiceError(ServiceError::Kind::invalid,
                       "after_sequence is " + std::to_string(after) +
                           "; it cannot be negative. Use the number of the last event seen.");
  }
  if (after > stored.last_sequence) {
    throw ServiceError(ServiceError::Kind::out_of_range,
                       "after_sequence is " + std::to_string(after) + ", but the last event of " + store::name_of(job) +
                           " is " + std::to_string(stored.last_sequence) + ". Use the number of the last event seen.");
  }
  ended_ = store::is_terminal(stored.job.state()) && after == stored.last_sequence;
}

std::optional<SentMessage> WatchCursor::next() {
  if (!std::exchange(snapshot_sent_, true)) return snapshot();
  // Not between the parts of a frame.
  if (parts_.empty()) {
    if (auto part = mesh_part()) return part;
  }
  if (ended_) return std::nullopt;
  // The journal is read before the channel, so that progress and frames from before a job's end precede its last event.
  // Not between the parts of a frame, which are already in memory.
  if (events_.empty() && parts_.empty()) {
    const auto read = recent_.after(journal_, job_, after_, channel_->stamp());
    events_.assign(read.begin(), read.end());
  }
  // A mesh is published before the first sample is durable, and comes before it.
  if (parts_.empty() && !events_.empty() && events_.front()->is_sample) {
    if (auto part = mesh_part()) return part;
  }
  if (auto event = transient()) return event;
  if (events_.empty()) return std::nullopt;
  const auto event = std::move(events_.front());
  events_.pop_front();
  after_ = event->sequence;
  ended_ = event->is_last;
  if (event->begins_again) mesh_queued_ = false;
  return SentMessage{.shared = SharedBytes(event, &event->bytes), .is_numbered = true};
}

bool WatchCursor::is_quiet() const {
  if (!snapshot_sent_ || ended_ || has_more()) return false;
  const auto newest = channel_->newest();
  return newest.progress_count <= progress_given_ && (!wanted_.frames || newest.frame_count <= frames_given_) &&
         (!wanted_.mesh || mesh_queued_ || !newest.mesh) && recent_.ends_with(job_, after_, channel_->stamp());
}

SentMessage WatchCursor::bookmark() const {
  v1::JobEvent event;
  event.set_sequence(after_);
  event.mutable_bookmark();
  return encode(std::move(event));
}

SentMessage WatchCursor::snapshot() {
  v1::JobEvent event;
  event.set_sequence(after_);
  auto& snapshot = *event.mutable_snapshot();
  snapshot.set_epoch(journal_.epoch().id);
  *snapshot.mutable_job() = find_job(journal_, job_).job;
  const auto newest = channel_->newest();
  if (!store::is_terminal(snapshot.job().state())) snapshot.mutable_job()->set_place(newest.place);
  if (newest.progress && snapshot.job().state() == v1::Job::RUNNING) {
    *snapshot.mutable_job()->mutable_progress() = *newest.progress;
    progress_given_ = newest.progress_count;
  }
  return encode(std::move(event));
}

// The channel of a running job has its mesh; that of a job that ran before the watch is in the journal.
void WatchCursor::queue_mesh() {
  if (!wanted_.mesh || mesh_queued_) return;
  if (const auto mesh = channel_->newest().mesh) {
    mesh_parts_.assign(mesh->parts().begin(), mesh->parts().end());
  } else if (!std::exchange(mesh_looked_up_, true)) {
    if (auto stored = journal_.mesh(job_)) {
      const PublishedMesh own(*std::move(stored));
      mesh_parts_.assign(own.parts().begin(), own.parts().end());
    }
  }
  mesh_queued_ = !mesh_parts_.empty();
}

std::optional<SentMessage> WatchCursor::mesh_part() {
  queue_mesh();
  if (mesh_parts_.empty()) return std::nullopt;
  return part_of(v1::JobEvent::kMeshFieldNumber, mesh_parts_);
}

std::optional<SentMessage> WatchCursor::transient() {
  if (!parts_.empty()) return frame_part();
  const auto newest = channel_->newest();
  if (newest.progress && newest.progress_count > progress_given_) {
    progress_given_ = newest.progress_count;
    v1::JobEvent event;
    event.set_sequence(after_);
    *event.mutable_progress() = *newest.progress;
    return encode(std::move(event));
  }
  if (!wanted_.frames || !newest.frame || newest.frame_count <= frames_given_) return std::nullopt;
  frames_given_ = newest.frame_count;
  queue_frame(*newest.frame);
  auto first = frame_part();
  first.skipped_frames = skipped_;
  return first;
}

void WatchCursor::queue_frame(const PublishedFrame& frame) {
  // A job that restarts from step 0 starts with its first frame.
  skipped_ = last_frame_ ? std::max(0, frame.index() - *last_frame_ - 1) : 0;
  last_frame_ = frame.index();
  const auto& parts = frame.parts(wanted_.encoding);
  parts_.assign(parts.begin(), parts.end());
}

SentMessage WatchCursor::frame_part() {
  v1::FrameChunk own;
  own.set_skipped(skipped_);
  return part_of(v1::JobEvent::kFrameFieldNumber, parts_, own.SerializeAsString());
}

SentMessage WatchCursor::part_of(int field, std::list<SharedBytes>& parts, std::string after) const {
  SentMessage part{.shared = std::move(parts.front()), .after = std::move(after)};
  parts.pop_front();
  v1::JobEvent event;
  event.set_sequence(after_);
  return nest(event.SerializeAsString(), field, std::move(part));
}

}  // namespace cellcrush::watch
