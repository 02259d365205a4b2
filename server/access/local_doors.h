#pragma once

#include <grpcpp/grpcpp.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "access/gate.h"
#include "mutex.h"

namespace cellcrush::access {

/// Ports of gRPC 1.51 for the connections of one address whose callers the kernel knows: one port for each caller,
/// since a call shows of its connection only what the port's credentials know. A port stays its caller's. Thread-safe.
class LocalDoors {
 public:
  using Port = grpc::experimental::ExternalConnectionAcceptor;

  /// Adds the ports to a server that is not built yet. `gate` outlives the server.
  LocalDoors(const Gate& gate, const ListenAddress& address, grpc::ServerBuilder& builder);
  ~LocalDoors();
  LocalDoors(LocalDoors&&) noexcept;
  LocalDoors& operator=(LocalDoors&&) = delete;

  /// The port of the connection's caller; null if none is left for a further one. May ask the user database
  /// (Gate::asks_user_database), without a lock.
  [[nodiscard]] Port* find_port(int connection);

 private:
  class Check;
  struct Door {
    std::shared_ptr<Check> check;
    std::unique_ptr<Port> port;
  };

  const Gate& gate_;
  std::vector<Door> doors_;  ///< the first one is for connections without a caller
  std::unique_ptr<Mutex> mutex_ = std::make_unique<Mutex>();  ///< guards the callers of doors
  std::size_t taken_ = 1;
};

}  // namespace cellcrush::access
