#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "rpc/stream_state.h"
#include "store/input_file.h"

namespace cellcrush::rpc {

/// Source of a DownloadResult: a file in chunks, each read after the previous one was sent. Not thread-safe.
class DownloadSource final : public PlainSource<v1::DownloadResultResponse> {
 public:
  /// Throws ServiceError: invalid for a negative offset, out_of_range for one past the end, and the errors of
  /// InputFile.
  DownloadSource(const std::filesystem::path& path, std::int64_t offset);

  /// Sends at least one message, so that the size is known even if no bytes are left. Before the first message, checks
  /// the whole file against its seal. Throws ServiceError: data_loss for a damaged file.
  std::optional<Message> next();
  [[nodiscard]] bool ended() const { return sent_ && offset_ == file_.size(); }
  [[nodiscard]] std::string resume_advice() const { return "with offset " + std::to_string(offset_); }

 private:
  std::filesystem::path path_;
  store::InputFile file_;
  std::int64_t offset_;
  bool sent_ = false;
};

}  // namespace cellcrush::rpc
