#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "jobs/frame_series.h"
#include "rpc/services.h"
#include "rpc/stream_state.h"
#include "store/durable_file.h"
#include "store/result_reader.h"

namespace cellcrush::rpc {

/// The requested frame of a result: the nearest one to a strain or time, or the one with an index. Throws ServiceError:
/// out_of_range for an index that does not exist, and the errors of ResultReader. REQUIRES: a strain or time is finite.
v1::FieldFrame read_frame(const store::ResultReader& result, const v1::GetFrameRequest& request);

/// Source of a GetFrame: the mesh and one frame, in parts. Not thread-safe.
class FrameSource final : public QueuedSource<v1::GetFrameResponse> {
 public:
  /// `parts` outlives the source. Throws ServiceError (invalid) for a strain or time that is not a finite number.
  FrameSource(const ServiceParts& parts, store::StoredJob job, v1::GetFrameRequest request);

  void prepare(const Call&) { read(); }
  [[nodiscard]] bool is_large() const;
  [[nodiscard]] static std::string resume_advice() { return "for the frame"; }

 private:
  /// Throws ServiceError: failed_precondition while the job has no frame, out_of_range for an index that does not
  /// exist, and the errors of store::ResultReader.
  void read() override;
  [[nodiscard]] v1::FieldFrame find_frame() const;

  const ServiceParts& parts_;
  store::StoredJob job_;
  v1::GetFrameRequest request_;
};

/// Source of a StreamFrames: the times of all frames, the mesh, then the wanted frames, one after another. Not
/// thread-safe.
class FrameSeriesSource final : public QueuedSource<v1::StreamFramesResponse> {
 public:
  /// `parts` outlives the source. Throws InvalidField for a request that is not valid.
  FrameSeriesSource(const ServiceParts& parts, store::StoredJob job, const v1::StreamFramesRequest& request);

  /// Throws ServiceError: failed_precondition while the job has no frame, out_of_range if `from` is beyond the last
  /// one, and the errors of jobs::FrameSeries.
  void prepare(const Call&);
  [[nodiscard]] bool is_large() const;
  [[nodiscard]] std::string resume_advice() const { return "from frame " + std::to_string(next_); }

 private:
  void read() override;

  const ServiceParts& parts_;
  store::StoredJob job_;
  v1::StreamFramesRequest request_;
  std::unique_ptr<jobs::FrameSeries> series_;  ///< null until it is prepared
  std::optional<v1::Mesh> mesh_;
  int next_;   ///< index of the next frame to read
  int last_ = -1;  ///< of the last frame to send
};

/// Source of a DownloadResult: a file in chunks, each read after the previous one was sent. Not thread-safe.
class DownloadSource final : public PlainSource<v1::DownloadResultResponse> {
 public:
  /// Throws ServiceError: invalid for a negative offset, out_of_range for one past the end, and the errors of
  /// InputFile.
  DownloadSource(const std::filesystem::path& path, std::int64_t offset);

  /// Checks the whole file against its seal, and sums up what the caller has of it. Throws ServiceError: data_loss for
  /// a damaged file.
  void prepare(const Call& call);
  [[nodiscard]] bool is_large() const;

  /// Sends at least one message, so that the size is known even if no bytes are left.
  std::optional<Message> next();
  [[nodiscard]] bool ended() const { return sent_ && offset_ == file_.size(); }
  [[nodiscard]] std::string resume_advice() const { return "with offset " + std::to_string(offset_); }

 private:
  void add_to_crc(const std::string& bytes);

  std::filesystem::path path_;
  store::InputFile file_;
  std::int64_t offset_;
  std::uint32_t crc_ = 0;  ///< of all bytes before offset_
  bool sent_ = false;
};

}  // namespace cellcrush::rpc
