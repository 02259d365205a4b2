#include "watch/watch_cursor.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "error.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"
#include "watch/sent_frame.h"

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

std::optional<v1::JobEvent> WatchCursor::next() {
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
  if (parts_.empty() && !events_.empty() && events_.front()->has_sample()) {
    if (auto part = mesh_part()) return part;
  }
  if (auto event = transient()) return event;
  if (events_.empty()) return std::nullopt;
  v1::JobEvent event = *events_.front();
  events_.pop_front();
  after_ = event.sequence();
  ended_ = event.has_state() && store::is_terminal(event.state().state());
  if (begins_again(event)) mesh_queued_ = false;
  return event;
}

v1::JobEvent WatchCursor::bookmark() const {
  v1::JobEvent event;
  event.set_sequence(after_);
  event.mutable_bookmark();
  return event;
}

v1::JobEvent WatchCursor::snapshot() {
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
  return event;
}

// The channel of a running job has its mesh; that of a job that ran before the watch is in the journal.
void WatchCursor::queue_mesh() {
  if (!wanted_.mesh || mesh_queued_) return;
  std::vector<v1::MeshChunk> parts;
  if (const auto mesh = channel_->newest().mesh) {
    parts = chunks_of(*mesh);
  } else if (!std::exchange(mesh_looked_up_, true)) {
    if (const auto stored = journal_.mesh(job_)) parts = chunks_of(*stored);
  }
  mesh_queued_ = !parts.empty();
  mesh_parts_.assign(std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()));
}

std::optional<v1::JobEvent> WatchCursor::mesh_part() {
  queue_mesh();
  if (mesh_parts_.empty()) return std::nullopt;
  v1::JobEvent event;
  event.set_sequence(after_);
  *event.mutable_mesh() = std::move(mesh_parts_.front());
  mesh_parts_.pop_front();
  return event;
}

std::optional<v1::JobEvent> WatchCursor::transient() {
  v1::JobEvent event;
  event.set_sequence(after_);
  if (parts_.empty()) {
    const auto newest = channel_->newest();
    if (newest.progress && newest.progress_count > progress_given_) {
      progress_given_ = newest.progress_count;
      *event.mutable_progress() = *newest.progress;
      return event;
    }
    if (wanted_.frames && newest.frame && newest.frame_count > frames_given_) {
      frames_given_ = newest.frame_count;
      queue_frame(newest.frame->in(wanted_.encoding));
    }
  }
  if (parts_.empty()) return std::nullopt;
  *event.mutable_frame() = std::move(parts_.front());
  parts_.pop_front();
  return event;
}

void WatchCursor::queue_frame(const v1::FieldFrame& frame) {
  auto parts = chunks_of(frame);
  if (last_frame_) {
    // A job that restarts from step 0 starts with its first frame.
    const int skipped = std::max(0, frame.index() - *last_frame_ - 1);
    for (auto& part : parts) part.set_skipped(skipped);
  }
  last_frame_ = frame.index();
  parts_.assign(std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()));
}

}  // namespace cellcrush::watch
