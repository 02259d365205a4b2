#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "jobs/frame_series.h"
#include "store/data_folder.h"
#include "store/journal_reader.h"

namespace cellcrush::rpc {

/// Source of a StreamFrames: the times of all frames, the mesh, then the wanted frames, one after another. Not
/// thread-safe.
class FrameSeriesSource {
 public:
  using Message = v1::StreamFramesResponse;
  static constexpr bool kIsWatch = false;

  /// Both outlive the source. Throws InvalidField for a request that is not valid.
  FrameSeriesSource(const store::DataFolder& folder, store::JournalReader& reader, store::StoredJob job,
                    const v1::StreamFramesRequest& request);

  void open(const std::function<void()>&) {}
  void close() {}
  /// Throws ServiceError: failed_precondition while the job has no frame, out_of_range if `from` is beyond the last
  /// one, and the errors of jobs::FrameSeries.
  std::optional<Message> next();
  [[nodiscard]] bool has_more() const { return !messages_.empty(); }
  [[nodiscard]] bool ended() const { return series_ && messages_.empty() && next_ > last_; }
  [[nodiscard]] std::optional<Message> bookmark() const { return std::nullopt; }
  [[nodiscard]] std::string resume_advice() const { return "from frame " + std::to_string(next_); }

 private:
  void begin();
  void queue_frame();

  const store::DataFolder& folder_;
  store::JournalReader& reader_;
  store::StoredJob job_;
  v1::StreamFramesRequest request_;
  std::unique_ptr<jobs::FrameSeries> series_;  ///< null before the first message
  std::optional<v1::Mesh> mesh_;
  int next_ = 0;                  ///< index of the next frame to read
  int last_ = -1;                 ///< of the last frame to send
  std::deque<Message> messages_;  ///< still to send
};

}  // namespace cellcrush::rpc
