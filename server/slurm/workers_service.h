#pragma once

#include <filesystem>
#include <utility>

#include "mutex.h"
#include "rpc/call_pool.h"
#include "slurm/attempt_folder.h"
#include "slurm/workers.grpc.pb.h"

namespace cellcrush::slurm {

/// Lets tasks without a shared file system reach the folders of their attempts, below NAME/attempts for the cluster of
/// that name. Admits a caller by the token of the attempt; the gate does not. Thread-safe.
class WorkersService final : public Workers::CallbackService {
 public:
  /// `root`: of the clusters' folders. `calls` outlives it.
  WorkersService(std::filesystem::path root, rpc::CallPool& calls) : root_(std::move(root)), calls_(calls) {}

  grpc::ServerUnaryReactor* ClaimAttempt(grpc::CallbackServerContext* context, const ClaimAttemptRequest* request,
                                         ClaimAttemptResponse* response) override;
  grpc::ServerUnaryReactor* ReadFile(grpc::CallbackServerContext* context, const ReadFileRequest* request,
                                     ReadFileResponse* response) override;
  grpc::ServerUnaryReactor* Contact(grpc::CallbackServerContext* context, const ContactRequest* request,
                                    ContactResponse* response) override;
  grpc::ServerUnaryReactor* WriteFile(grpc::CallbackServerContext* context, const WriteFileRequest* request,
                                      WriteFileResponse* response) override;
  grpc::ServerUnaryReactor* EndAttempt(grpc::CallbackServerContext* context, const EndAttemptRequest* request,
                                       EndAttemptResponse* response) override;

 private:
  /// Throws ServiceError (permission_denied) unless the call has the attempt's token.
  [[nodiscard]] AttemptFolder admit(const grpc::CallbackServerContext& context, const AttemptName& name) const;

  std::filesystem::path root_;
  rpc::CallPool& calls_;
  Mutex uploads_;  ///< a part of a file is written as a whole, also by a call that was given up
};

}  // namespace cellcrush::slurm
