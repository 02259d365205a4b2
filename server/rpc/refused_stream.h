#pragma once

#include <grpcpp/support/status.h>

namespace cellcrush::rpc {

/// A stream that is refused before it starts. Reactor is a gRPC server reactor.
template <class Reactor>
class RefusedStream final : public Reactor {
 public:
  explicit RefusedStream(const grpc::Status& status) { this->Finish(status); }
  void OnDone() override { delete this; }
};

}  // namespace cellcrush::rpc
