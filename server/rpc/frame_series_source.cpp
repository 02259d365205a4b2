#include "rpc/frame_series_source.h"

#include <algorithm>
#include <utility>

#include "error.h"
#include "watch/frame_chunks.h"
#include "watch/packed_frame.h"

namespace cellcrush::rpc {
namespace {

void check(const v1::StreamFramesRequest& request) {
  const auto refuse = [](const char* field, int value, const std::string& least) {
    throw InvalidField(field, "is " + std::to_string(value) + ", below " + least + ".",
                       "Frames are numbered from 0; use a number of at least " + least + ".");
  };
  if (request.from() < 0) refuse("from", request.from(), "0");
  if (request.has_to() && request.to() < request.from()) refuse("to", request.to(), std::to_string(request.from()));
  if (request.stride() < 0) refuse("stride", request.stride(), "0");
}

}  // namespace

FrameSeriesSource::FrameSeriesSource(const store::DataFolder& folder, store::JournalReader& reader,
                                     store::StoredJob job, const v1::StreamFramesRequest& request)
    : folder_(folder), reader_(reader), job_(std::move(job)), request_(request) {
  check(request_);
}

void FrameSeriesSource::begin() {
  series_ = jobs::open_frame_series(folder_.job_folder(job_.number));
  const int count = series_ ? static_cast<int>(series_->times().time_s_size()) : 0;
  if (count == 0) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       job_.job.name() + " is " + v1::Job::State_Name(job_.job.state()) +
                           " and has no frames. A job has frames once it runs, and keeps them with its result.");
  }
  if (request_.from() >= count) {
    throw ServiceError(ServiceError::Kind::out_of_range, "from is " + std::to_string(request_.from()) +
                                                             ", but frames are numbered from 0 to " +
                                                             std::to_string(count - 1) + ". Use one of these.");
  }
  next_ = request_.from();
  last_ = request_.has_to() ? std::min(request_.to(), count - 1) : count - 1;
  *messages_.emplace_back().mutable_times() = series_->times();
  mesh_ = reader_.mesh(job_.number);
  if (!mesh_) return;
  for (auto& chunk : watch::chunks_of(*mesh_)) *messages_.emplace_back().mutable_mesh() = std::move(chunk);
}

void FrameSeriesSource::queue_frame() {
  auto frame = series_->frame(next_);
  if (request_.encoding() == v1::FieldFrame::PACKED) frame = watch::pack(frame, mesh_ ? &*mesh_ : nullptr);
  for (auto& chunk : watch::chunks_of(frame)) *messages_.emplace_back().mutable_frame() = std::move(chunk);
  next_ += std::max(1, request_.stride());
}

std::optional<FrameSeriesSource::Message> FrameSeriesSource::next() {
  if (!series_) begin();
  if (messages_.empty() && next_ <= last_) queue_frame();
  if (messages_.empty()) return std::nullopt;
  Message out = std::move(messages_.front());
  messages_.pop_front();
  return out;
}

}  // namespace cellcrush::rpc
