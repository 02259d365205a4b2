#pragma once

#include <map>
#include <memory>
#include <string>

#include "programs/certificates.h"
#include "server/daemon_fixture.h"

namespace cellcrush::testing {

/// How a client comes to a daemon: what it trusts, shows and sends.
struct Visitor {
  std::filesystem::path authority;  ///< empty: plain text
  CertificateFiles shown;
  std::string token;
};

/// A daemon on a socket and a port, an authority that signs its certificates, and tokens of reader (read), anna and bob
/// (submit) and chief (admin). Each test starts the daemon.
class GateFixture : public DaemonFixture {
 protected:
  void SetUp() override;

  [[nodiscard]] DaemonOptions tcp_options(const std::string& address = "127.0.0.1:0") const;
  [[nodiscard]] DaemonOptions with_tokens(DaemonOptions options) const;
  [[nodiscard]] DaemonOptions with_tls(DaemonOptions options, const CertificateRequest& request = {}) const;

  /// What the daemon says when it does not start; empty when it does.
  [[nodiscard]] std::string refusal_of_start(const DaemonOptions& options);

  /// A channel to the port; with TLS it carries the token.
  [[nodiscard]] std::shared_ptr<grpc::Channel> channel(const Visitor& visitor,
                                                       const std::string& host = "127.0.0.1") const;

  /// A client without TLS that has one of the tokens.
  [[nodiscard]] Client client_of(const std::string& name) const;

  /// A context that carries the token where the channel does not.
  [[nodiscard]] static std::unique_ptr<grpc::ClientContext> context_of(const Visitor& visitor);

  /// Calls ListJobs, with a deadline of ten seconds.
  [[nodiscard]] grpc::Status list(const Visitor& visitor, const std::string& host = "127.0.0.1") const;

  /// Who trusts the authority and has one of the tokens.
  [[nodiscard]] Visitor with(const std::string& name) const;

  Authority authority_{folder_.path(), "authority"};
  Authority other_authority_{folder_.path(), "other-authority"};
  std::map<std::string, std::string> tokens_;
};

}  // namespace cellcrush::testing
