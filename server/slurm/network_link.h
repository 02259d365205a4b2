#pragma once

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "slurm/link.h"
#include "slurm/workers.grpc.pb.h"

namespace cellcrush::slurm {

/// How tasks without a shared file system reach the daemon.
struct NetworkAddress {
  std::string daemon;     ///< HOST:PORT
  std::string authority;  ///< PEM file of the authority that issued the daemon's certificate; empty: the system's
};

/// A channel to the daemon: with TLS, but in plain text to a loopback address without an authority. Throws ServiceError
/// if the authority's file cannot be read.
std::shared_ptr<grpc::Channel> open_channel(const NetworkAddress& address);

/// Reaches the daemon over the network, with the token of one attempt.
class NetworkLink final : public Link {
 public:
  NetworkLink(const std::shared_ptr<grpc::Channel>& channel, const std::string& cluster, const std::string& attempt,
              std::string token);

  bool claim(const Claim& claim) override;
  void fetch(const store::JobFolder& to) override;
  void beat(std::uint64_t number) override;
  Request::Kind requested() override;
  void write_reports(std::uint64_t offset, const std::string& bytes) override;
  void put_checkpoint(const std::string& bytes) override;
  void put_result(const std::filesystem::path& file) override;
  void end(const Ended& ended) override;

 private:
  template <typename Request, typename Response>
  using Method = grpc::Status (Workers::Stub::*)(grpc::ClientContext*, const Request&, Response*);
  /// Throws ServiceError if the call fails.
  template <typename Request, typename Response>
  Response call(Method<Request, Response> method, const Request& request);
  /// `checksum`: of the whole file, with its last part.
  void write_file(const std::string& file, std::int64_t offset, std::string bytes,
                  std::optional<std::uint32_t> checksum = std::nullopt);

  std::unique_ptr<Workers::Stub> stub_;
  AttemptName name_;
  std::string token_;
};

}  // namespace cellcrush::slurm
