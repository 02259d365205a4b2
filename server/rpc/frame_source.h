#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "store/data_folder.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::rpc {

/// Source of a GetFrame: the mesh and one frame, in parts. Not thread-safe.
class FrameSource {
 public:
  using Message = v1::GetFrameResponse;
  static constexpr bool kIsWatch = false;

  /// All of it outlives the source.
  struct Parts {
    const store::DataFolder& folder;
    store::JournalReader& reader;
    watch::Hub& hub;
  };

  /// Throws ServiceError (invalid) for a strain or time that is not a finite number.
  FrameSource(const Parts& parts, store::StoredJob job, v1::GetFrameRequest request);

  void open(const std::function<void()>&) {}
  void close() {}
  /// Reads the frame on the first call. Throws ServiceError: failed_precondition while the job has no frame,
  /// out_of_range for an index that does not exist, and the errors of store::ResultReader.
  std::optional<Message> next();
  [[nodiscard]] bool has_more() const { return !messages_.empty(); }
  [[nodiscard]] bool ended() const { return was_read_ && messages_.empty(); }
  [[nodiscard]] std::optional<Message> bookmark() const { return std::nullopt; }
  [[nodiscard]] std::string resume_advice() const { return "for the frame"; }

 private:
  [[nodiscard]] v1::FieldFrame find_frame() const;
  void read();

  Parts parts_;
  store::StoredJob job_;
  v1::GetFrameRequest request_;
  bool was_read_ = false;
  std::deque<Message> messages_;  ///< still to send
};

}  // namespace cellcrush::rpc
