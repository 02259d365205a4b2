#include "access/gate.h"

#include <grpc/grpc_security_constants.h>
#include <spdlog/spdlog.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "access/call_backlog.h"
#include "access/tls_credentials.h"
#include "access/unix_user.h"
#include "error.h"
#include "error_table.h"

namespace cellcrush::access {
namespace {

constexpr std::size_t kLongestPath = 128;  // of a method in the log
constexpr std::size_t kMostKnownCertificates = 256;
constexpr std::size_t kMostCalls = 4'000;                    // over gRPC, open at once
constexpr std::size_t kMostMembers = 200;                    // callers whom a group lets in, while the daemon runs
constexpr const char* kCallerProperty = "cellcrush_caller";  // of a connection: scope and name
constexpr const char* kAskForToken =
    "The server's administrator creates tokens with `cellcrushd token NAME --scope SCOPE`.";

[[noreturn]] void refuse_options(const std::string& why) { throw ServiceError(ServiceError::Kind::invalid, why); }

[[noreturn]] void refuse_caller(const std::string& why) {
  throw ServiceError(ServiceError::Kind::unauthenticated, why);
}

[[noreturn]] void refuse_certificate() {
  refuse_caller(
      "The certificate of this call is not a client certificate: its extended key usage lacks clientAuth. Ask the "
      "issuing authority for one with extendedKeyUsage = clientAuth.");
}

[[noreturn]] Caller refuse_stranger() {
  refuse_caller(
      "This server belongs to " + own_user() + ", and serves its owner and those whom the owner lets in. " +
      "Ask for a token (--tokens) or for access to its Unix socket (--group-scope). For a browser of your own, "
      "run `cellcrush open`.");
}

bool is_unix_socket(int connection) {
  sockaddr_storage name{};
  socklen_t size = sizeof(name);
  return getsockname(connection, reinterpret_cast<sockaddr*>(&name), &size) == 0 && name.ss_family == AF_UNIX;
}

std::string_view view_of(const grpc::string_ref& text) { return {text.data(), text.size()}; }

constexpr std::string_view kBearer = "Bearer ";

bool is_bearer(std::string_view authorization) {
  return authorization.size() > kBearer.size() &&
         strncasecmp(authorization.data(), kBearer.data(), kBearer.size()) == 0;
}

}  // namespace

// Authenticates the caller of each call on a port, before the call reaches a service.
class Gate::Check final : public grpc::AuthMetadataProcessor {
 public:
  explicit Check(const Gate& gate) : gate_(gate) {}

  // It computes a hash and does not wait.
  [[nodiscard]] bool IsBlocking() const override { return false; }

  // Stores nothing in the context: all calls of a connection share it, but may have different tokens.
  grpc::Status Process(const InputMetadata& metadata, grpc::AuthContext* context, OutputMetadata*,
                       OutputMetadata*) override {
    const auto found = metadata.find(":path");
    const auto path = found == metadata.end() ? std::string_view() : view_of(found->second);
    std::string caller;
    auto status = gate_.admit(path, [&] {
      gate_.check_certificate(*context);
      auto known = gate_.identify(metadata, *context);
      caller = known.name;
      return known;
    });
    return status.ok() ? gate_.find_place(path, caller, *context) : status;
  }

 private:
  const Gate& gate_;
};

grpc::Status Gate::admit(std::string_view path, const std::function<Caller()>& identify_caller) const {
  std::string name;
  auto status = answer([&] {
    const auto guarded = scopes_.find(path);
    const auto needed = guarded == scopes_.end() ? Scope::admin : guarded->second;
    if (!needed) return;
    const Caller caller = identify_caller();
    if (caller.scope >= *needed) return;
    name = caller.name;
    throw ServiceError(ServiceError::Kind::permission_denied,
                       std::string(path.substr(path.rfind('/') + 1)) + " requires scope " + name_of(*needed) + "; " +
                           caller.name + " has scope " + name_of(caller.scope) + ".");
  });
  if (!status.ok()) {
    const bool unknown = status.error_code() == grpc::StatusCode::UNAUTHENTICATED;
    note_refusal(std::string(unknown ? "UNAUTHENTICATED: " : "PERMISSION_DENIED: ") +
                 std::string(path.substr(0, kLongestPath)) + ": " + status.error_message());
    if (on_refused) on_refused(path.substr(0, kLongestPath), name, status);
  }
  return status;
}

grpc::Status Gate::check_local_call(std::string_view path, const std::optional<Caller>& caller,
                                    grpc::AuthContext& context) const {
  if (caller) {
    const MutexLock lock(contexts_);
    if (context.FindPropertyValues(kCallerProperty).empty())
      context.AddProperty(kCallerProperty, name_of(caller->scope) + " " + caller->name);
  }
  auto status = admit(path, [&] {
    if (!caller) refuse_stranger();
    return *caller;
  });
  return status.ok() ? find_place(path, caller ? caller->name : "", context) : status;
}

grpc::Status Gate::find_place(std::string_view path, const std::string& caller,
                              const grpc::AuthContext& connection) const {
  if (backlog_->admit(key_of(connection))) return grpc::Status::OK;
  note_refusal("RESOURCE_EXHAUSTED: its connection has too many open calls");
  const grpc::Status out{
      grpc::StatusCode::RESOURCE_EXHAUSTED,
      "Too many calls of this connection are open or wait to begin. Make fewer at once, and try again later."};
  if (on_refused) on_refused(path.substr(0, kLongestPath), caller, out);
  return out;
}

const void* Gate::key_of(const grpc::AuthContext& connection) const {
  const MutexLock lock(contexts_);
  const auto kept = connection.FindPropertyValues(GRPC_TRANSPORT_SECURITY_TYPE_PROPERTY_NAME);
  return kept.empty() ? nullptr : kept.front().data();  // every connection keeps a copy of its own
}

std::optional<Caller> Gate::find_local_caller(int connection) const {
  const auto user = user_of_peer(connection);
  if (!user) return std::nullopt;
  if (*user == geteuid()) return Caller{own_user(), Scope::admin};
  if (!is_unix_socket(connection)) return std::nullopt;
  if (*user == 0) return Caller{name_of_user(0), Scope::admin};
  std::optional<Scope> scope;
  if (!groups_.empty()) {
    for (const gid_t group : groups_of_user(*user)) {
      const auto found = groups_.find(group);
      if (found != groups_.end()) scope = std::max(scope.value_or(Scope::read), found->second);
    }
  }
  return scope ? std::optional(Caller{name_of_user(*user), *scope}) : std::nullopt;
}

bool Gate::asks_user_database(int connection) const {
  return is_unix_socket(connection) && user_of_peer(connection) != geteuid();
}

std::size_t Gate::most_local_callers() const { return 2 + (groups_.empty() ? 0 : kMostMembers); }

Caller Gate::caller_of_http(const HttpCredentials& shown) const {
  if (asks_for_certificates() && (shown.certificate == nullptr || !is_for_clients(*shown.certificate)))
    refuse_certificate();
  // A proxy may ask for a password of its own: "Basic ...".
  Metadata metadata;
  for (const auto& value : shown.authorization) {
    if (is_bearer(value)) metadata.emplace("authorization", value);
  }
  if (metadata.empty()) {
    if (auto of_session = sessions_.find(shown.session, shown.user)) return *of_session;
  }
  if (!asks_who_calls()) return shown.user == geteuid() ? Caller{own_user(), Scope::admin} : refuse_stranger();
  return caller_of_token(metadata);
}

grpc::Status Gate::check_http_call(const std::string& path, const HttpCredentials& shown, Caller& caller) const {
  return admit(path, [&] { return caller = caller_of_http(shown); });
}

void Gate::check_http_address(const ListenAddress& address) const {
  const std::string start = "Cannot serve HTTP on " + address.text();
  if (address.kind != ListenAddress::Kind::tcp) refuse_options(start + ": use --http HOST:PORT.");
  if (asks_for_certificates() && !has_tokens()) {
    refuse_options(start +
                   " with --tls-client-ca alone: over HTTP only a token names the caller. Give --tokens FILE as well, "
                   "or --http none.");
  }
  if (address.is_loopback() || (has_tls() && has_tokens())) return;
  refuse_options(start + ", which other machines can reach, without " +
                 (has_tls() ? "" : "TLS (--tls-cert FILE --tls-key FILE)") +
                 (has_tls() || has_tokens() ? "" : " and ") + (has_tokens() ? "" : "tokens (--tokens FILE)") +
                 ". Give what is missing, or a loopback address, such as --http 127.0.0.1:8080.");
}

Gate::Gate(const Options& options) : options_(options), backlog_(std::make_unique<CallBacklog>(kMostCalls)) {
  if (options.tls_certificate.empty() != options.tls_key.empty())
    refuse_options("--tls-cert and --tls-key belong together. Give both or neither.");
  if (!options.tls_client_authority.empty() && options.tls_certificate.empty())
    refuse_options("--tls-client-ca needs TLS. Give --tls-cert and --tls-key with it.");
  if (has_tls()) read_tls();
  if (has_tokens()) read_tokens();
  for (const auto& [name, scope] : options.groups) {
    const auto group = find_group(name);
    if (!group)
      refuse_options("--group-scope " + name + "=" + name_of(scope) + ": there is no Unix group " + name + ".");
    groups_[*group] = scope;
  }
}

Gate::~Gate() = default;

std::string Gate::read_tls() {
  auto next = std::make_shared<const TlsFiles>(
      read_tls_files(options_.tls_certificate, options_.tls_key, options_.tls_client_authority));
  const MutexLock lock(mutex_);
  tls_ = std::move(next);
  return tls_->description;
}

std::string Gate::read_tokens() {
  auto next = std::make_shared<const TokenFile>(options_.tokens);
  const MutexLock lock(mutex_);
  tokens_ = std::move(next);
  sessions_.end_all();
  return std::to_string(tokens_->size()) + " of --tokens " + options_.tokens.string();
}

void Gate::read_again(const char* what, std::string (Gate::*read)()) {
  try {
    spdlog::info("{} reloaded: {}", what, (this->*read)());
  } catch (const ServiceError& error) {
    spdlog::error("{} The previous {} stay in force. Fix the file and send SIGHUP again.", error.what(), what);
  }
}

void Gate::read_files_again() {
  if (has_tls()) read_again("certificates", &Gate::read_tls);
  if (has_tokens()) read_again("tokens", &Gate::read_tokens);
  if (!has_tls() && !has_tokens()) spdlog::info("nothing to reload: neither --tls-cert nor --tokens was given");
}

std::shared_ptr<const TlsFiles> Gate::tls() const {
  const MutexLock lock(mutex_);
  return tls_;
}

std::shared_ptr<const TokenFile> Gate::tokens() const {
  const MutexLock lock(mutex_);
  return tokens_;
}

std::shared_ptr<grpc::ServerCredentials> Gate::credentials_for(
    const ListenAddress& address, const std::shared_ptr<grpc::AuthMetadataProcessor>& check) const {
  const bool is_unix = address.kind == ListenAddress::Kind::unix_socket;
  if (!address.is_loopback() && (!has_tls() || !asks_who_calls())) {
    refuse_options("Cannot listen on " + address.text() + ", which other machines can reach, without " +
                   (has_tls() ? "" : "TLS (--tls-cert FILE --tls-key FILE) and ") +
                   "client authentication (--tokens FILE or --tls-client-ca FILE). Give " +
                   (has_tls() ? "one" : "these") + ", or listen on 127.0.0.1, localhost or [::1].");
  }
  std::shared_ptr<grpc::ServerCredentials> out;
  if (has_tls() && !is_unix) {
    out = std::make_shared<TlsCredentials>([this] { return tls(); });
  } else {
    // Plain text on this machine only. Unlike insecure credentials, these allow calls to be checked.
    out = grpc::experimental::LocalServerCredentials(is_unix ? UDS : LOCAL_TCP);
  }
  if (check) {
    out->SetAuthMetadataProcessor(check);
  } else if (asks_who_calls() && !is_unix) {
    out->SetAuthMetadataProcessor(std::make_shared<Check>(*this));
  }
  return out;
}

Caller Gate::identify(const Metadata& metadata, const grpc::AuthContext& context) const {
  return has_tokens() ? caller_of_token(metadata) : caller_of_certificate(context);
}

Caller Gate::caller_of_token(const Metadata& metadata) const {
  const auto [first, last] = metadata.equal_range("authorization");
  if (first == last) {
    refuse_caller(std::string("This server requires a token, and this call has none. Send it as the header "
                              "\"Authorization: Bearer TOKEN\"; for cellcrush, name a file that holds it, with "
                              "--token-file FILE or CELLCRUSH_TOKEN_FILE. ") +
                  kAskForToken);
  }
  const std::string_view value = view_of(first->second);
  if (std::next(first) != last || !is_bearer(value))
    refuse_caller("The authorization metadata of this call is not a single \"Bearer TOKEN\". Send exactly one.");
  const auto caller = tokens()->find(value.substr(kBearer.size()));
  if (!caller) refuse_caller(std::string("The server does not recognise the token of this call. ") + kAskForToken);
  return *caller;
}

void Gate::check_certificate(const grpc::AuthContext& context) const {
  if (!asks_for_certificates()) return;
  const auto shown = context.FindPropertyValues(GRPC_X509_PEM_CERT_PROPERTY_NAME);
  if (shown.size() != 1) refuse_certificate();
  const std::string_view pem = view_of(shown.front());
  const MutexLock lock(mutex_);
  auto found = for_clients_.find(pem);
  if (found == for_clients_.end()) {
    if (for_clients_.size() == kMostKnownCertificates) for_clients_.clear();
    found = for_clients_.emplace(pem, is_for_clients(pem)).first;
  }
  if (!found->second) refuse_certificate();
}

Caller Gate::caller_of_certificate(const grpc::AuthContext& context) const {
  const auto names = context.FindPropertyValues("x509_common_name");
  const std::string_view name = names.size() == 1 ? view_of(names.front()) : std::string_view();
  if (!is_caller_name(name)) {
    refuse_caller(
        "The common name of this call's certificate cannot be used as an owner name. Use 1 to 64 printable characters "
        "without spaces, quotes, backslashes or #, and not \"local\".");
  }
  return {std::string(name), options_.certificate_scope};
}

std::optional<Caller> Gate::local_caller_of(const grpc::AuthContext& connection) const {
  const MutexLock lock(contexts_);
  const auto local = connection.FindPropertyValues(kCallerProperty);
  if (local.empty()) return std::nullopt;
  const std::string_view text = view_of(local.front());
  const auto space = text.find(' ');
  return Caller{std::string(text.substr(space + 1)), parse_scope(text.substr(0, space)).value()};
}

Caller Gate::caller_of(const grpc::ServerContextBase& context) const {
  const auto connection = context.auth_context();
  if (const auto local = local_caller_of(*connection)) return *local;
  return asks_who_calls() ? identify(context.client_metadata(), *connection) : refuse_stranger();
}

void Gate::note_refusal(const std::string& words) const {
  refusals_.write(spdlog::level::warn, "refused a call with " + words);
}

void Gate::require_own(const Caller& caller, const std::string& owner, const std::string& name) const {
  if (caller.scope == Scope::admin || caller.name == owner) return;
  const std::string why = name + " belongs to " + (owner.empty() ? "nobody" : owner) + "; " + caller.name +
                          " has scope " + name_of(caller.scope) +
                          ", which permits changes to its own jobs and sweeps only.";
  note_refusal("PERMISSION_DENIED: " + why);
  if (on_refused) on_refused("", caller.name, {grpc::StatusCode::PERMISSION_DENIED, why});
  throw ServiceError(ServiceError::Kind::permission_denied, why + " Ask its owner, or someone with scope admin.");
}

}  // namespace cellcrush::access
