#pragma once

#include <grpcpp/support/status.h>

#include <functional>
#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "store/journal_reader.h"
#include "watch/hub.h"
#include "watch/job_source.h"

namespace cellcrush::rpc {

/// A requested job of a WatchJobs: what its WatchJob would send, and how it would end. Not thread-safe, except for
/// `wake`.
class WatchedJob {
 public:
  /// A request that is not valid throws nothing: its status is the first message.
  WatchedJob(store::JournalReader& journal, watch::Hub& hub, const v1::WatchJobRequest& request);

  void open(const std::function<void()>& wake);
  void close();

  std::optional<v1::WatchJobsResponse> next();
  [[nodiscard]] bool has_more() const { return source_ && source_->has_more(); }

 private:
  v1::WatchJobsResponse end(const grpc::Status& status);

  std::string name_;
  std::optional<watch::JobSource> source_;
  std::optional<grpc::Status> refused_;  ///< until it was sent
  bool is_open_ = false;
};

}  // namespace cellcrush::rpc
