#pragma once

#include <grpcpp/support/client_interceptor.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace cellcrush::client {

/// The epoch of the server that a channel reached first. Every later call of the channel names it, so that a server
/// which came back with other data refuses the call: its jobs have the same names. Thread-safe.
class ServerEpoch {
 public:
  using Interceptors = std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>>;

  /// For the calls of one channel; `epoch` lives as long as they do.
  static Interceptors interceptors_for(const std::shared_ptr<ServerEpoch>& epoch);

  /// Empty before the first answer, and from a server of a version without epochs.
  [[nodiscard]] std::string seen() const;

  /// Whether a server of another epoch has answered since.
  [[nodiscard]] bool has_changed() const;

  void note(const std::string& epoch);

 private:
  mutable std::mutex mutex_;
  std::string seen_;
  bool has_changed_ = false;
};

}  // namespace cellcrush::client
