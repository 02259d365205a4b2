#include "watch/job_source.h"

#include <utility>

namespace cellcrush::watch {

JobSource::JobSource(store::JournalReader& journal, Hub& hub, std::int64_t job, std::int64_t after,
                     WatchCursor::Wanted wanted)
    : channel_(hub.open(job)), frames_(wanted.frames), cursor_(journal, hub, job, after, wanted) {}

void JobSource::open(std::function<void()> wake) { subscription_ = channel_->subscribe(std::move(wake), frames_); }

void JobSource::close() { channel_->unsubscribe(subscription_); }

std::string JobSource::resume_advice() const {
  return "with after_sequence " + std::to_string(cursor_.bookmark().sequence());
}

}  // namespace cellcrush::watch
