#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/security/auth_metadata_processor.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "access/client_certificates.h"
#include "access/scope.h"
#include "access/tls_files.h"
#include "access/token_file.h"
#include "limited_log.h"
#include "listen_address.h"
#include "mutex.h"

namespace cellcrush::access {

/// Files that say who may call, as the options of the daemon name them; empty ones are not given.
struct Options {
  std::filesystem::path tls_certificate;
  std::filesystem::path tls_key;
  std::filesystem::path tls_client_authority;
  std::filesystem::path tokens;
  /// Of those who show a certificate; where there are tokens too, these say it.
  Scope certificate_scope = Scope::submit;
};

/// Who may call, and what. Every call on TCP passes it before it reaches a service; the Unix socket is guarded by its
/// file's permissions. Refused calls are warned of in the log. Thread-safe.
class Gate {
 public:
  /// Reads the files. Throws ServiceError (invalid) for options that do not go together, and for a file that cannot be
  /// used.
  explicit Gate(const Options& options);

  /// With what a server listens on the address, including the check of each call. The gate and the credentials outlive
  /// the server. Throws ServiceError (invalid) where others could reach it and there is no TLS, or neither tokens nor
  /// clients' certificates.
  [[nodiscard]] std::shared_ptr<grpc::ServerCredentials> credentials_for(const ListenAddress& address) const;

  /// Reads the certificates, their authority and the tokens again: connections and calls from now on are held to them.
  /// What was read stands in the log. Files that cannot be used are named there, and those from before stay in force.
  void read_files_again();

  /// Who makes a call that has passed.
  [[nodiscard]] Caller caller_of(const grpc::ServerContextBase& context) const;

  /// Throws ServiceError (permission_denied) unless the caller owns `name` or has the scope admin.
  void require_own(const grpc::ServerContextBase& context, const std::string& owner, const std::string& name) const;

 private:
  using Metadata = std::multimap<grpc::string_ref, grpc::string_ref>;
  class Check;

  /// Throws ServiceError (unauthenticated) for a call without what it needs.
  [[nodiscard]] Caller identify(const Metadata& metadata, const grpc::AuthContext& context) const;
  /// Throws ServiceError (unauthenticated) for a certificate that is not for clients.
  void check_certificate(const grpc::AuthContext& context) const;
  [[nodiscard]] Caller caller_of_token(const Metadata& metadata) const;
  [[nodiscard]] Caller caller_of_certificate(const grpc::AuthContext& context) const;
  /// `words` are the status, what was refused and why, and hold no secret.
  void note_refusal(const std::string& words) const;
  [[nodiscard]] bool asks_who_calls() const { return has_tokens() || asks_for_certificates(); }
  [[nodiscard]] bool asks_for_certificates() const { return !options_.tls_client_authority.empty(); }
  [[nodiscard]] bool has_tls() const { return !options_.tls_certificate.empty(); }
  [[nodiscard]] bool has_tokens() const { return !options_.tokens.empty(); }
  [[nodiscard]] std::shared_ptr<const TlsFiles> tls() const;
  [[nodiscard]] std::shared_ptr<const TokenFile> tokens() const;
  /// Return what was read, in words. Throw ServiceError (invalid) for files that cannot be used.
  std::string read_tls();
  std::string read_tokens();
  void read_again(const char* what, std::string (Gate::*read)());

  Options options_;
  mutable Mutex mutex_;
  std::shared_ptr<const TlsFiles> tls_ CELLCRUSH_GUARDED_BY(mutex_);      ///< null where there is no TLS
  std::shared_ptr<const TokenFile> tokens_ CELLCRUSH_GUARDED_BY(mutex_);  ///< null where there are none
  mutable ClientCertificates client_certificates_;
  mutable LimitedLog refusals_{"refused calls", 1};
};

}  // namespace cellcrush::access
