#include "rpc/result_sources.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "error.h"
#include "store/result_seal.h"
#include "watch/sent_frame.h"

namespace cellcrush::rpc {
namespace {

// Memory held by an unread download.
constexpr std::size_t kDownloadChunk = 128 * 1024;

// Reading a file of this size takes seconds.
constexpr std::int64_t kLargeFile = 256 << 20;

// Whether what the job has to show is in such a file: its result, or else the reports of its worker.
bool has_large_file(const ServiceParts& parts, std::int64_t job) {
  const auto folder = parts.folder.job_folder(job);
  const auto found = store::find_own(folder.result());
  const auto file = found ? found : store::find_own(folder.reports());
  return file && file->st_size >= kLargeFile;
}

// Position of the value nearest to `wanted`.
int nearest(const std::vector<double>& values, double wanted) {
  const auto closer = [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  return static_cast<int>(std::min_element(values.begin(), values.end(), closer) - values.begin());
}

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

v1::FieldFrame read_frame(const store::ResultReader& result, const v1::GetFrameRequest& request) {
  const auto times = result.frame_times();
  const int last = static_cast<int>(times.size()) - 1;
  switch (request.which_case()) {
    case v1::GetFrameRequest::kStrain: return result.frame(nearest(result.frame_strains(), request.strain()));
    case v1::GetFrameRequest::kTimeS: return result.frame(nearest(times, request.time_s()));
    case v1::GetFrameRequest::kIndex:
      if (request.index() < -1 || request.index() > last) {
        throw ServiceError(ServiceError::Kind::out_of_range,
                           "index is " + std::to_string(request.index()) + ", but frames are numbered from 0 to " +
                               std::to_string(last) + ". Use one of these, or -1 for the last frame.");
      }
      return result.frame(request.index() == -1 ? last : request.index());
    case v1::GetFrameRequest::WHICH_NOT_SET: break;
  }
  return result.frame(last);
}

FrameSource::FrameSource(const ServiceParts& parts, store::StoredJob job, v1::GetFrameRequest request)
    : parts_(parts), job_(std::move(job)), request_(std::move(request)) {
  if ((request_.has_strain() && !std::isfinite(request_.strain())) ||
      (request_.has_time_s() && !std::isfinite(request_.time_s())))
    throw ServiceError(ServiceError::Kind::invalid,
                       "The strain or time of the requested frame is not finite. Use a finite number.");
}

bool FrameSource::is_large() const { return has_large_file(parts_, job_.number); }

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
  return frame->numbers();
}

void FrameSource::read() {
  const auto frame = find_frame();
  if (const auto mesh = parts_.reader.mesh(job_.number)) {
    for (auto& chunk : watch::chunks_of(*mesh)) *messages_.emplace_back().mutable_mesh() = std::move(chunk);
  }
  for (auto& chunk : watch::chunks_of(frame)) *messages_.emplace_back().mutable_chunk() = std::move(chunk);
  is_read_ = true;
}

FrameSeriesSource::FrameSeriesSource(const ServiceParts& parts, store::StoredJob job,
                                     const v1::StreamFramesRequest& request)
    : parts_(parts), job_(std::move(job)), request_(request), next_(request.from()) {
  check(request_);
}

bool FrameSeriesSource::is_large() const { return has_large_file(parts_, job_.number); }

void FrameSeriesSource::prepare(const Call&) {
  series_ = jobs::open_frame_series(parts_.folder.job_folder(job_.number));
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
  last_ = request_.has_to() ? std::min(request_.to(), count - 1) : count - 1;
  *messages_.emplace_back().mutable_times() = series_->times();
  mesh_ = parts_.reader.mesh(job_.number);
  if (!mesh_) return;
  for (auto& chunk : watch::chunks_of(*mesh_)) *messages_.emplace_back().mutable_mesh() = std::move(chunk);
}

void FrameSeriesSource::read() {
  auto frame = series_->frame(next_);
  if (request_.encoding() == v1::FieldFrame::PACKED) frame = watch::pack(frame, mesh_ ? &*mesh_ : nullptr);
  for (auto& chunk : watch::chunks_of(frame)) *messages_.emplace_back().mutable_frame() = std::move(chunk);
  next_ += std::max(1, request_.stride());
  is_read_ = next_ > last_;
}

DownloadSource::DownloadSource(const std::filesystem::path& path, std::int64_t offset)
    : path_(path), file_(path, store::LastLink::of_owner), offset_(offset) {
  if (offset < 0) throw InvalidField("offset", "is negative.", "Use 0 for the whole file.");
  if (offset > file_.size()) {
    throw ServiceError(ServiceError::Kind::out_of_range, "offset is " + std::to_string(offset) + ", but the file has " +
                                                             std::to_string(file_.size()) + " bytes.");
  }
}

std::optional<DownloadSource::Message> DownloadSource::next() {
  if (ended()) return std::nullopt;
  Message out;
  out.set_offset(offset_);
  out.set_total_size(file_.size());
  out.set_data(file_.read(offset_, kDownloadChunk));
  offset_ += static_cast<std::int64_t>(out.data().size());
  add_to_crc(out.data());
  out.set_crc32(crc_);
  sent_ = true;
  return out;
}

bool DownloadSource::is_large() const { return file_.size() >= kLargeFile; }

void DownloadSource::prepare(const Call& call) {
  store::check_seal_if_any(path_, [&call] { call.require_wanted(); });
  for (std::int64_t at = 0; at < offset_;) {
    call.require_wanted();
    const auto left = static_cast<std::size_t>(offset_ - at);
    const std::string part = file_.read(at, std::min(kDownloadChunk, left));
    if (part.empty()) break;
    add_to_crc(part);
    at += static_cast<std::int64_t>(part.size());
  }
}

void DownloadSource::add_to_crc(const std::string& bytes) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  crc_ = static_cast<std::uint32_t>(crc32_z(crc_, data, bytes.size()));
}

}  // namespace cellcrush::rpc
