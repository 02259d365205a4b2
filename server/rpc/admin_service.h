#pragma once

#include <atomic>
#include <functional>

#include "access/gate.h"
#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "jobs/queues.h"
#include "rpc/call_pool.h"
#include "rpc/queue_listing.h"

namespace cellcrush::rpc {

/// State and control of the daemon. Thread-safe.
class AdminService final : public v1::Admin::CallbackService {
 public:
  /// All of it outlives the service.
  struct Parts {
    QueueListing::Parts listing;
    const access::Gate& gate;
    CallPool& calls;
    std::function<void()> drain;
  };

  explicit AdminService(const Parts& parts) : parts_(parts), listing_(parts.listing) {}

  grpc::ServerUnaryReactor* GetCapabilities(grpc::CallbackServerContext* context,
                                            const v1::GetCapabilitiesRequest* request,
                                            v1::Capabilities* response) override;
  grpc::ServerUnaryReactor* GetQueue(grpc::CallbackServerContext* context, const v1::GetQueueRequest* request,
                                     v1::Queue* response) override;
  grpc::ServerUnaryReactor* Drain(grpc::CallbackServerContext* context, const v1::DrainRequest* request,
                                  v1::DrainResponse* response) override;

 private:
  Parts parts_;
  QueueListing listing_;
  std::atomic<bool> draining_ = false;
};

}  // namespace cellcrush::rpc
