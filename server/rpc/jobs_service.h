#pragma once

#include "rpc/export_source.h"
#include "rpc/jobs_source.h"
#include "rpc/result_sources.h"
#include "rpc/service_parts.h"
#include "watch/job_source.h"

namespace cellcrush::rpc {

/// Jobs and their results. Thread-safe. Streams hold no thread, even for slow readers; the pools run all other calls.
class JobsService {
 public:
  explicit JobsService(const ServiceParts& parts) : parts_(parts) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  // The calls; errors as exceptions, or as a status with details.
  grpc::Status create_job(const Call& call, const v1::CreateJobRequest& request, v1::Job& response);
  grpc::Status get_job(const Call&, const v1::GetJobRequest& request, v1::Job& response);
  grpc::Status list_jobs(const Call& call, const v1::ListJobsRequest& request, v1::ListJobsResponse& response);
  grpc::Status cancel_job(const Call& call, const v1::CancelJobRequest& request, v1::Job& response);
  grpc::Status suspend_job(const Call& call, const v1::SuspendJobRequest& request, v1::Job& response);
  grpc::Status resume_job(const Call& call, const v1::ResumeJobRequest& request, v1::Job& response);
  grpc::Status delete_job(const Call& call, const v1::DeleteJobRequest& request, v1::DeleteJobResponse&);
  grpc::Status get_history(const Call&, const v1::GetHistoryRequest& request, v1::GetHistoryResponse& response);
  // Sources of the streams. They throw what ends the stream.
  std::unique_ptr<watch::JobSource> watch_job(const v1::WatchJobRequest& request);
  std::unique_ptr<JobsSource> watch_jobs(const v1::WatchJobsRequest& request);
  std::unique_ptr<FrameSeriesSource> stream_frames(const v1::StreamFramesRequest& request);
  std::unique_ptr<FrameSource> get_frame(const v1::GetFrameRequest& request);
  std::unique_ptr<DownloadSource> download(const v1::DownloadResultRequest& request);
  std::unique_ptr<ExportSource> export_job(const v1::ExportJobRequest& request);

  /// Throws ServiceError (not_found) if there is none.
  store::StoredJob find(const std::string& name);
  /// Number of a job that the caller may change. Also throws ServiceError (permission_denied).
  std::int64_t find_own(const Call& call, const std::string& name);
  /// Adds what is not in the journal: progress and place.
  void add_live(store::StoredJob& stored);
  void commit_samples();

  ServiceParts parts_;
  ExportPlaces exports_;
};

}  // namespace cellcrush::rpc
