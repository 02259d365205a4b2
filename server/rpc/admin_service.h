#pragma once

#include <atomic>
#include <functional>

#include "cellcrush/v1/admin_service.pb.h"
#include "jobs/queues.h"
#include "rpc/method_table.h"
#include "rpc/queue_listing.h"

namespace cellcrush::rpc {

/// State and control of the daemon. Thread-safe.
class AdminService {
 public:
  /// All of it outlives the service.
  struct Parts {
    QueueListing::Parts listing;
    CallPool& calls;
    std::function<void()> drain;
  };

  explicit AdminService(const Parts& parts) : parts_(parts), listing_(parts.listing) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  grpc::Status get_capabilities(const Call&, const v1::GetCapabilitiesRequest&, v1::Capabilities& response);
  grpc::Status get_queue(const Call&, const v1::GetQueueRequest&, v1::Queue& response);
  grpc::Status drain(const Call& call, const v1::DrainRequest&, v1::DrainResponse&);

  Parts parts_;
  QueueListing listing_;
  std::atomic<bool> draining_ = false;
};

}  // namespace cellcrush::rpc
