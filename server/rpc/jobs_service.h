#pragma once

#include "access/gate.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "jobs/admission.h"
#include "jobs/deletion.h"
#include "jobs/scheduler.h"
#include "rpc/stream_reactor.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::rpc {

/// Jobs and their results. Thread-safe. Streams go through gRPC's callbacks and hold no thread, however slowly they are
/// read; all other calls are short.
class JobsService final
    : public v1::Jobs::WithCallbackMethod_WatchJob<
          v1::Jobs::WithCallbackMethod_GetFrame<v1::Jobs::WithCallbackMethod_DownloadResult<v1::Jobs::Service>>> {
 public:
  /// All of it outlives the service.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    const jobs::Deletion& deletion;
    watch::Hub& hub;
    jobs::Scheduler& scheduler;
    jobs::Admission& admission;
    const access::Gate& gate;
    StreamParts streams;
  };

  explicit JobsService(const Parts& parts) : parts_(parts) {}

  grpc::Status CreateJob(grpc::ServerContext* context, const v1::CreateJobRequest* request, v1::Job* response) override;
  grpc::Status GetJob(grpc::ServerContext* context, const v1::GetJobRequest* request, v1::Job* response) override;
  grpc::Status ListJobs(grpc::ServerContext* context, const v1::ListJobsRequest* request,
                        v1::ListJobsResponse* response) override;
  grpc::Status CancelJob(grpc::ServerContext* context, const v1::CancelJobRequest* request, v1::Job* response) override;
  grpc::Status SuspendJob(grpc::ServerContext* context, const v1::SuspendJobRequest* request,
                          v1::Job* response) override;
  grpc::Status ResumeJob(grpc::ServerContext* context, const v1::ResumeJobRequest* request, v1::Job* response) override;
  grpc::Status DeleteJob(grpc::ServerContext* context, const v1::DeleteJobRequest* request,
                         v1::DeleteJobResponse* response) override;
  grpc::ServerWriteReactor<v1::JobEvent>* WatchJob(grpc::CallbackServerContext* context,
                                                   const v1::WatchJobRequest* request) override;
  grpc::Status GetHistory(grpc::ServerContext* context, const v1::GetHistoryRequest* request,
                          v1::GetHistoryResponse* response) override;
  grpc::ServerWriteReactor<v1::GetFrameResponse>* GetFrame(grpc::CallbackServerContext* context,
                                                           const v1::GetFrameRequest* request) override;
  grpc::ServerWriteReactor<v1::DownloadResultResponse>* DownloadResult(
      grpc::CallbackServerContext* context, const v1::DownloadResultRequest* request) override;

 private:
  /// Throws ServiceError (not_found) when there is none.
  store::StoredJob find(const std::string& name);
  /// Number of a job that the caller may change. Throws also ServiceError (permission_denied).
  std::int64_t find_own(const grpc::ServerContext& context, const std::string& name);
  void add_progress(store::StoredJob& stored);
  void commit_samples();

  Parts parts_;
};

}  // namespace cellcrush::rpc
