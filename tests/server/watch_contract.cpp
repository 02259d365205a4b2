#include "server/watch_contract.h"

#include "store/job_state.h"

namespace cellcrush::testing {

void WatchContract::require(bool kept, const std::string& promise) {
  if (!kept) broken_.push_back(promise + " (behind " + std::to_string(sequence_) + ")");
}

void WatchContract::see(const v1::JobEvent& event) {
  require(event.has_snapshot() != any_, "The snapshot comes first and once.");
  require(!job_ended_, "Nothing comes behind the job's last state.");
  any_ = true;
  if (event.has_state() || event.has_sample()) {
    see_numbered(event);
    return;
  }
  require(event.sequence() == sequence_, "What has no number of its own carries that of the last event.");
  require(event.has_frame() || parts_left_ == 0, "The parts of a frame come together.");
  if (event.has_snapshot()) had_ended_ = store::is_terminal(event.snapshot().job().state());
  if (event.has_frame()) see_frame(event.frame());
}

void WatchContract::see_numbered(const v1::JobEvent& event) {
  require(event.sequence() > sequence_, "No event comes twice or out of order, as " + std::to_string(event.sequence()));
  const bool begins_again = event.has_state() && event.state().begun_again_sequence() == event.sequence();
  if (begins_again) {
    step_ = -1;
    gap_.reset();
  } else if (event.sequence() > sequence_ + 1) {
    require(event.has_state(), "No event is missing before " + std::to_string(event.sequence()));
    gap_ = event.sequence();
  }
  require(parts_left_ == 0, "The parts of a frame come together.");
  sequence_ = event.sequence();
  if (event.has_sample()) {
    require(event.sample().step() > step_, "Samples go forward.");
    step_ = event.sample().step();
  } else {
    const v1::Job::State next = event.state().state();
    require(sequence_ != 1 || next == v1::Job::PENDING, "A job begins PENDING.");
    require(!state_ || begins_again || store::may_follow(*state_, next), "A state follows one that it may follow.");
    state_ = next;
    job_ended_ = store::is_terminal(next);
  }
  numbered_.push_back(event);
}

void WatchContract::see_frame(const v1::FrameChunk& chunk) {
  const int index = chunk.frame().index();
  if (parts_left_ > 0) {
    require(index == frame_ && chunk.part() == chunk.part_count() - parts_left_, "Parts come in order.");
    --parts_left_;
    return;
  }
  require(chunk.part() == 0, "A frame begins with its first part.");
  require(!frame_ || index > *frame_, "Frames go forward.");
  require(chunk.skipped() == (frame_ ? index - *frame_ - 1 : 0), "Frames that were left out are counted.");
  frame_ = index;
  parts_left_ = chunk.part_count() - 1;
}

void WatchContract::end(const grpc::Status& status) {
  require(!gap_, "Events are missing before " + std::to_string(gap_.value_or(0)) + " only if the job begins again.");
  const bool all = job_ended_ || (had_ended_ && numbered_.empty());
  require(!status.ok() || all, "OK comes only behind the job's last state.");
  require(!status.ok() || any_, "A watch that ends with OK had a snapshot.");
}

}  // namespace cellcrush::testing
