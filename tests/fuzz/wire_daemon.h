#pragma once

#include <grpcpp/grpcpp.h>

#include <filesystem>
#include <memory>
#include <string>

namespace cellcrush::fuzz {

/// A daemon's Service on a data folder, without workers and reached over a
/// channel within this process: calls pass gRPC's own reading of bytes as they do from outside.
class WireDaemon {
 public:
  explicit WireDaemon(const std::filesystem::path& data_folder);
  ~WireDaemon();
  WireDaemon(const WireDaemon&) = delete;
  WireDaemon& operator=(const WireDaemon&) = delete;

  /// How a call ended, and the bytes of its last message.
  struct Answer {
    grpc::Status status;
    std::string message;
  };

  /// Makes a call of any kind, with any bytes as its message. A watch is broken off when it has nothing more to say for
  /// now.
  Answer call(const std::string& method, const std::string& request, bool is_watch);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cellcrush::fuzz
