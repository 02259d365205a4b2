#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/security/auth_metadata_processor.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "access/sessions.h"
#include "access/tls_files.h"
#include "access/token_file.h"
#include "limited_log.h"
#include "listen_address.h"
#include "mutex.h"

namespace cellcrush::access {

class CallBacklog;

/// Files that define who may call, as the daemon's options name them. An empty path means that the option was not
/// given.
struct Options {
  std::filesystem::path tls_certificate;
  std::filesystem::path tls_key;
  std::filesystem::path tls_client_authority;
  std::filesystem::path tokens;
  /// scopes of callers with a certificate; if the daemon uses tokens, the token decides
  Scope certificate_scope = Scope::submit;
  /// What members of Unix groups, by name, may do on Unix sockets.
  std::map<std::string, Scope> groups;
};

/// What a call over HTTP shows of its caller.
struct HttpCredentials {
  std::vector<std::string> authorization;  ///< all values of that header
  std::string session;                     ///< of Sessions; empty: none
  std::optional<uid_t> user;               ///< who has opened the connection, as far as the kernel says
  const X509* certificate = nullptr;       ///< null: none
};

/// Authenticates and authorizes callers. Every call is checked here before it reaches a service. Refused calls are
/// logged as warnings. Thread-safe.
class Gate {
 public:
  /// Reads the files. Throws ServiceError (invalid) for conflicting options and for an unusable file.
  explicit Gate(const Options& options);
  ~Gate();

  /// Credentials for listening on the address. They check each call with `check`; if it is null, by token or
  /// certificate where callers must have one. The gate and the credentials outlive the server. Throws ServiceError
  /// (invalid) if other machines can reach the address without TLS, or without tokens and client certificates.
  [[nodiscard]] std::shared_ptr<grpc::ServerCredentials> credentials_for(
      const ListenAddress& address, const std::shared_ptr<grpc::AuthMetadataProcessor>& check = nullptr) const;

  /// Whether the kernel says who calls on the address: on Unix sockets, and on loopback without tokens and client
  /// certificates.
  [[nodiscard]] bool knows_local_callers(const ListenAddress& address) const {
    return address.kind == ListenAddress::Kind::unix_socket || !asks_who_calls();
  }

  /// The caller at the other end of such a connection; nothing if it has no scope or is unknown. The user that runs
  /// this process has the scope admin; on Unix sockets root has it too, and members of Options::groups have theirs.
  [[nodiscard]] std::optional<Caller> find_local_caller(int connection) const;

  /// Whether find_local_caller asks the user database, which may take seconds if it is on another machine.
  [[nodiscard]] bool asks_user_database(int connection) const;

  /// How many different callers find_local_caller may find.
  [[nodiscard]] std::size_t most_local_callers() const;

  /// Checks a call on a connection of this caller. `context`, of the connection, remembers the caller for caller_of.
  [[nodiscard]] grpc::Status check_local_call(std::string_view path, const std::optional<Caller>& caller,
                                              grpc::AuthContext& context) const;

  /// The calls over gRPC that the gate has let in.
  [[nodiscard]] CallBacklog& backlog() const { return *backlog_; }

  /// Its key in the backlog.
  [[nodiscard]] const void* key_of(const grpc::AuthContext& connection) const;

  /// Callers of this method need the scope; nothing: everybody may call it. A method without this needs admin. `path`
  /// has gRPC's form: "/cellcrush.v1.Jobs/GetJob". REQUIRES: no call has come.
  void guard(std::string path, std::optional<Scope> scope) { scopes_[std::move(path)] = scope; }

  /// Called for each call that the gate refuses. `caller`: empty if it is not known; `path`: empty for a call that had
  /// begun. Thread-safe. REQUIRES: no call has come.
  std::function<void(std::string_view path, const std::string& caller, const grpc::Status& status)> on_refused;

  /// Checks a call that came over HTTP, before it reaches a service: `path` as in gRPC. The rules, refusals and log
  /// lines are those of a gRPC call on TCP; a session stands for a token. Sets `caller`, except for a method that is
  /// open to everybody.
  [[nodiscard]] grpc::Status check_http_call(const std::string& path, const HttpCredentials& shown,
                                             Caller& caller) const;

  /// Browsers that were let in.
  [[nodiscard]] Sessions& sessions() const { return sessions_; }

  /// Throws ServiceError (invalid) if HTTP must not be served on the address: other machines can reach it without TLS
  /// and tokens, or certificates alone tell who calls.
  void check_http_address(const ListenAddress& address) const;

  /// The files read last; null without TLS. The same object until they change.
  [[nodiscard]] std::shared_ptr<const TlsFiles> tls() const;

  /// Rereads the certificates, their authority and the tokens. They apply to every connection and call from now on. The
  /// log names the files read. It also names unusable files, whose previous contents stay in force.
  void read_files_again();

  /// The caller whom the kernel knows at the other end of a connection; nothing if it knows none.
  [[nodiscard]] std::optional<Caller> local_caller_of(const grpc::AuthContext& connection) const;

  /// The caller of an admitted call.
  [[nodiscard]] Caller caller_of(const grpc::ServerContextBase& context) const;

  /// Throws ServiceError (permission_denied) unless the caller owns `name` or has the scope admin.
  void require_own(const Caller& caller, const std::string& owner, const std::string& name) const;

 private:
  using Metadata = std::multimap<grpc::string_ref, grpc::string_ref>;
  class Check;

  /// Answers a call that needs a scope. `identify_caller` says who calls, and throws ServiceError (unauthenticated). If
  /// the call is refused, the log says so.
  [[nodiscard]] grpc::Status admit(std::string_view path, const std::function<Caller()>& identify_caller) const;
  /// Refuses an admitted call if it is one too many of its connection.
  [[nodiscard]] grpc::Status find_place(std::string_view path, const std::string& caller,
                                        const grpc::AuthContext& connection) const;
  /// Throws ServiceError (unauthenticated) for a call without the required credentials.
  [[nodiscard]] Caller identify(const Metadata& metadata, const grpc::AuthContext& context) const;
  /// Throws ServiceError (unauthenticated) for a certificate not issued for clients.
  void check_certificate(const grpc::AuthContext& context) const;
  [[nodiscard]] Caller caller_of_token(const Metadata& metadata) const;
  [[nodiscard]] Caller caller_of_http(const HttpCredentials& shown) const;
  [[nodiscard]] Caller caller_of_certificate(const grpc::AuthContext& context) const;
  /// `words`: the status, what was refused and why; free of secrets.
  void note_refusal(const std::string& words) const;
  [[nodiscard]] bool asks_who_calls() const { return has_tokens() || asks_for_certificates(); }
  [[nodiscard]] bool asks_for_certificates() const { return !options_.tls_client_authority.empty(); }
  [[nodiscard]] bool has_tls() const { return !options_.tls_certificate.empty(); }
  [[nodiscard]] bool has_tokens() const { return !options_.tokens.empty(); }
  [[nodiscard]] std::shared_ptr<const TokenFile> tokens() const;
  /// Return a description of what was read. Throw ServiceError (invalid) for unusable files.
  std::string read_tls();
  std::string read_tokens();
  void read_again(const char* what, std::string (Gate::*read)());

  Options options_;
  std::map<std::string, std::optional<Scope>, std::less<>> scopes_;
  std::map<gid_t, Scope> groups_;
  mutable Sessions sessions_;
  mutable Mutex mutex_;
  std::shared_ptr<const TlsFiles> tls_ CELLCRUSH_GUARDED_BY(mutex_);      ///< null without TLS
  std::shared_ptr<const TokenFile> tokens_ CELLCRUSH_GUARDED_BY(mutex_);  ///< null without tokens
  /// Which certificates, as PEM, were issued for clients: the last answers, since every call asks.
  mutable std::map<std::string, bool, std::less<>> for_clients_ CELLCRUSH_GUARDED_BY(mutex_);
  std::unique_ptr<CallBacklog> backlog_;
  mutable Mutex contexts_;  ///< gRPC shares the context of a connection among its calls, without a lock
  mutable LimitedLog refusals_{"refused calls", 1};
};

}  // namespace cellcrush::access
