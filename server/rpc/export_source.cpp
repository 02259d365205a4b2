#include "rpc/export_source.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "error.h"
#include "rpc/request_fields.h"
#include "store/job_state.h"
#include "translate/case_checker.h"
#include "translate/case_words.h"
#include "translate/check_case.h"
#include "watch/sent_frame.h"
#include "web/exported_page.h"

namespace cellcrush::rpc {
namespace {

using web::Compression;

constexpr std::size_t kExportChunk = 128 * 1024;
constexpr std::int64_t kDefaultBytes = 20'000'000;
// Frames that are packed to learn how large they are. Their size grows with the strain.
constexpr int kMeasuredFrames = 4;

void append_frame_chunks(const v1::FieldFrame& frame, std::string& text) {
  v1::StreamFramesResponse message;
  for (auto& chunk : watch::chunks_of(frame)) {
    *message.mutable_frame() = std::move(chunk);
    text += web::exported_block("StreamFrames", message, Compression::none);
  }
}

}  // namespace

ExportSource::ExportSource(const Parts& parts, store::StoredJob job, const v1::ExportJobRequest& request)
    : parts_(parts), job_(std::move(job)), max_bytes_(request.max_bytes() == 0 ? kDefaultBytes : request.max_bytes()) {
  if (request.max_bytes() < 0) throw InvalidField("max_bytes", "is negative.", "Use 0 for the default.");
  if (!store::is_terminal(job_.job.state())) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       job_.job.name() + " is " + v1::Job::State_Name(job_.job.state()) +
                           " and cannot be exported yet. Wait until it has ended, or cancel it.");
  }
  if (job_.samples == 0 && !job_.job.has_start_time()) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       job_.job.name() + " was " + v1::Job::State_Name(job_.job.state()) +
                           " before it ran, so there is nothing to export. Submit its case again.");
  }
}

void ExportSource::prepare(const Call& call) {
  {
    const auto elements = translate::CaseChecker().elements_to_build(job_.job.case_());
    const jobs::MeshPlaces::Place place(parts_.places, elements, [&call] { return call.is_cancelled(); });
    auto check = translate::check_case(job_.job.case_(), [&call] { call.require_wanted(); }).response;
    translate::add_words(check);
    check_ = web::exported_block("CheckCase", check, Compression::zlib);
  }
  call.require_wanted();
  series_ = jobs::open_frame_series(parts_.folder.job_folder(job_.number));
}

// What a deleted job has lost would be missing without a word.
void ExportSource::check_is_there() {
  if (parts_.reader.has_job(job_.number)) return;
  throw ServiceError(ServiceError::Kind::not_found, job_.job.name() + " was deleted while it was exported.");
}

// Pages as of GetHistory, with their numbers as tokens.
void ExportSource::append_history() {
  auto stored = parts_.reader.samples(job_.number, last_sample_, {std::numeric_limits<int>::max(), kPageBytes});
  v1::GetHistoryResponse page;
  *page.mutable_samples() = {std::make_move_iterator(stored.samples.begin()),
                             std::make_move_iterator(stored.samples.end())};
  last_sample_ = stored.last_sequence;
  ++page_;
  if (stored.has_more) page.set_next_page_token(std::to_string(page_));
  text_ += web::exported_block("GetHistory", page, Compression::zlib);
  if (!stored.has_more) stage_ = Stage::times;
}

void ExportSource::append_times() {
  frame_count_ = series_ ? static_cast<int>(series_->times().time_s_size()) : 0;
  stage_ = frame_count_ > 0 ? Stage::mesh : Stage::end;
  if (frame_count_ == 0) return check_is_there();
  v1::StreamFramesResponse message;
  *message.mutable_times() = series_->times();
  text_ += web::exported_block("StreamFrames", message, Compression::zlib);
  mesh_ = parts_.reader.mesh(job_.number);
  check_is_there();
  for (auto& chunk : mesh_ ? watch::chunks_of(*mesh_) : std::vector<v1::MeshChunk>()) {
    mesh_chunks_.push_back(std::move(chunk));
  }
}

void ExportSource::append_mesh() {
  if (!mesh_chunks_.empty()) {
    v1::StreamFramesResponse message;
    *message.mutable_mesh() = std::move(mesh_chunks_.front());
    mesh_chunks_.pop_front();
    text_ += web::exported_block("StreamFrames", message, Compression::zlib);
  }
  if (mesh_chunks_.empty()) stage_ = Stage::frames;
}

// In the file.
double ExportSource::mean_frame_bytes(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const int index = ((2 * i + 1) * frame_count_) / (2 * count);
    append_frame_chunks(watch::pack(series_->frame(index), mesh_ ? &*mesh_ : nullptr), text);
  }
  return static_cast<double>(text.size()) / count;
}

void ExportSource::choose_frames() {
  const double room = std::max(0.0, static_cast<double>(max_bytes_ - size_));
  const double fitting = room / std::max(1.0, mean_frame_bytes(std::min(kMeasuredFrames, frame_count_)));
  // The first and the last frame are always there.
  const double steps = std::max(1.0, std::floor(fitting) - 1.0);
  stride_ = std::max(1, static_cast<int>(std::ceil((frame_count_ - 1) / steps)));
}

void ExportSource::append_frame() {
  if (next_frame_ == 0) choose_frames();
  append_frame_chunks(watch::pack(series_->frame(next_frame_), mesh_ ? &*mesh_ : nullptr), text_);
  const int last = frame_count_ - 1;
  if (next_frame_ == last) stage_ = Stage::end;
  next_frame_ = std::min(next_frame_ + stride_, last);
}

void ExportSource::append() {
  const std::size_t before = text_.size();
  switch (stage_) {
    case Stage::head:
      text_ += web::exported_head(job_.job.case_().title().empty() ? job_.job.name() : job_.job.case_().title());
      translate::add_words(job_.job);
      text_ += web::exported_block("GetJob", job_.job, Compression::zlib);
      stage_ = Stage::check;
      break;
    case Stage::check:
      text_ += std::exchange(check_, "");
      stage_ = Stage::history;
      break;
    case Stage::history: append_history(); break;
    case Stage::times: append_times(); break;
    case Stage::mesh: append_mesh(); break;
    case Stage::frames: append_frame(); break;
    case Stage::end:
      text_ += web::exported_end();
      stage_ = Stage::done;
      break;
    case Stage::done: break;
  }
  size_ += static_cast<std::int64_t>(text_.size() - before);
}

bool ExportSource::has_more() const {
  const std::size_t left = text_.size() - sent_;
  return left >= kExportChunk || (stage_ == Stage::done && left > 0);
}

std::optional<ExportSource::Message> ExportSource::next() {
  if (ended()) return std::nullopt;
  if (!has_more()) {
    text_.erase(0, std::exchange(sent_, 0));
    while (!has_more()) append();
  }
  Message out;
  out.set_data(text_.substr(sent_, kExportChunk));
  sent_ += out.data().size();
  out.set_job_frame_count(frame_count_);
  if (stage_ < Stage::frames || (stage_ == Stage::frames && next_frame_ == 0)) return out;
  const int last = std::max(0, frame_count_ - 1);
  out.set_frame_count(frame_count_ == 0 ? 0 : 1 + (last + stride_ - 1) / stride_);
  out.set_fraction(stage_ >= Stage::end ? 1.0 : static_cast<double>(next_frame_) / frame_count_);
  return out;
}

}  // namespace cellcrush::rpc
