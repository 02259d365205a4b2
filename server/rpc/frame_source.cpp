#include "rpc/frame_source.h"

#include <cmath>
#include <utility>

#include "error.h"
#include "rpc/result_frame.h"
#include "store/result_reader.h"
#include "watch/frame_chunks.h"

namespace cellcrush::rpc {

FrameSource::FrameSource(const Parts& parts, store::StoredJob job, v1::GetFrameRequest request)
    : parts_(parts), job_(std::move(job)), request_(std::move(request)) {
  if ((request_.has_strain() && !std::isfinite(request_.strain())) ||
      (request_.has_time_s() && !std::isfinite(request_.time_s())))
    throw ServiceError(ServiceError::Kind::invalid,
                       "The strain or time of the requested frame is not finite. Use a finite number.");
}

v1::FieldFrame FrameSource::find_frame() const {
  if (job_.job.has_summary())
    return read_frame(store::ResultReader(parts_.folder.job_folder(job_.number).result()), request_);
  const auto channel = parts_.hub.find(job_.number);
  const auto frame = channel ? channel->newest().frame : nullptr;
  if (!frame) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       job_.job.name() + " is " + v1::Job::State_Name(job_.job.state()) +
                           " and has no frames. A running job offers its newest frame. A job that SUCCEEDED, or was "
                           "cancelled or failed while running, offers all.");
  }
  return frame->in(v1::FieldFrame::NUMBERS);
}

void FrameSource::read() {
  const auto frame = find_frame();
  if (const auto mesh = parts_.reader.mesh(job_.number)) {
    for (auto& chunk : watch::chunks_of(*mesh)) *messages_.emplace_back().mutable_mesh() = std::move(chunk);
  }
  for (auto& chunk : watch::chunks_of(frame)) *messages_.emplace_back().mutable_chunk() = std::move(chunk);
  was_read_ = true;
}

std::optional<FrameSource::Message> FrameSource::next() {
  if (!was_read_) read();
  if (messages_.empty()) return std::nullopt;
  Message out = std::move(messages_.front());
  messages_.pop_front();
  return out;
}

}  // namespace cellcrush::rpc
