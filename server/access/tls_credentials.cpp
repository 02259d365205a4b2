#include "access/tls_credentials.h"

#include <grpc/grpc.h>
#include <grpc/grpc_security.h>
#include <grpcpp/security/auth_context.h>

#include <utility>

namespace cellcrush::access {
namespace {

using Processor = std::shared_ptr<grpc::AuthMetadataProcessor>;

grpc::string_ref slice_text(const grpc_slice& slice) {
  return {reinterpret_cast<const char*>(GRPC_SLICE_START_PTR(slice)), GRPC_SLICE_LENGTH(slice)};
}

// What TLS reports about a peer, for a processor.
class PeerContext final : public grpc::AuthContext {
 public:
  explicit PeerContext(grpc_auth_context* context) : context_(context) {}

  [[nodiscard]] bool IsPeerAuthenticated() const override {
    return grpc_auth_context_peer_is_authenticated(context_) != 0;
  }
  [[nodiscard]] std::vector<grpc::string_ref> GetPeerIdentity() const override {
    return values_of(grpc_auth_context_peer_identity(context_));
  }
  [[nodiscard]] std::string GetPeerIdentityPropertyName() const override {
    const char* name = grpc_auth_context_peer_identity_property_name(context_);
    return name == nullptr ? "" : name;
  }
  [[nodiscard]] std::vector<grpc::string_ref> FindPropertyValues(const std::string& name) const override {
    return values_of(grpc_auth_context_find_properties_by_name(context_, name.c_str()));
  }
  [[nodiscard]] grpc::AuthPropertyIterator begin() const override { return NoProperty(); }
  [[nodiscard]] grpc::AuthPropertyIterator end() const override { return NoProperty(); }
  void AddProperty(const std::string& name, const grpc::string_ref& value) override {
    grpc_auth_context_add_property(context_, name.c_str(), value.data(), value.size());
  }
  bool SetPeerIdentityPropertyName(const std::string&) override { return false; }

 private:
  struct NoProperty : grpc::AuthPropertyIterator {};

  static std::vector<grpc::string_ref> values_of(grpc_auth_property_iterator properties) {
    std::vector<grpc::string_ref> out;
    while (const grpc_auth_property* next = grpc_auth_property_iterator_next(&properties))
      out.emplace_back(next->value, next->value_length);
    return out;
  }

  grpc_auth_context* context_;
};

// gRPC accepts C++ processors only through its own credentials.
void process_call(void* state, grpc_auth_context* context, const grpc_metadata* metadata, std::size_t count,
                  grpc_process_auth_metadata_done_cb done, void* user_data) {
  grpc::AuthMetadataProcessor::InputMetadata input;
  for (std::size_t i = 0; i < count; ++i) input.emplace(slice_text(metadata[i].key), slice_text(metadata[i].value));
  PeerContext peer(context);
  grpc::AuthMetadataProcessor::OutputMetadata consumed;
  grpc::AuthMetadataProcessor::OutputMetadata response;
  const auto status = (*static_cast<Processor*>(state))->Process(input, &peer, &consumed, &response);
  done(user_data, nullptr, 0, nullptr, 0, static_cast<grpc_status_code>(status.error_code()),
       status.error_message().c_str());
}

void forget_processor(void* state) { delete static_cast<Processor*>(state); }

grpc_ssl_server_certificate_config* config_of(const TlsFiles& files) {
  const grpc_ssl_pem_key_cert_pair pair{files.key.c_str(), files.certificate.c_str()};
  // gRPC asserts an authority even if it requests no client certificate; it is then unused.
  const std::string& authority = files.client_authority.empty() ? files.certificate : files.client_authority;
  return grpc_ssl_server_certificate_config_create(authority.c_str(), &pair, 1);
}

}  // namespace

// Remembers per port which files it was given. Calls for a port are sequential.
struct TlsCredentials::Port {
  static grpc_ssl_certificate_config_reload_status fetch(void* port, grpc_ssl_server_certificate_config** config) {
    auto& [source, current] = *static_cast<Port*>(port);
    auto next = source();
    if (next == current) return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
    *config = config_of(*next);
    current = std::move(next);
    return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
  }

  const Source& source;
  std::shared_ptr<const TlsFiles> current;
};

TlsCredentials::TlsCredentials(Source source) : source_(std::move(source)) {}

TlsCredentials::~TlsCredentials() = default;

void TlsCredentials::SetAuthMetadataProcessor(const Processor& processor) { processor_ = processor; }

int TlsCredentials::AddPortToServer(const std::string& address, grpc_server* server) {
  Port& port = *ports_.emplace_back(std::make_unique<Port>(Port{source_, nullptr}));
  grpc_ssl_server_credentials_options* options = grpc_ssl_server_credentials_create_options_using_config_fetcher(
      source_()->client_authority.empty() ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
                                          : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY,
      &Port::fetch, &port);
  // Takes ownership of the options. The server keeps a reference to the credentials.
  grpc_server_credentials* credentials = grpc_ssl_server_credentials_create_with_options(options);
  if (processor_)
    grpc_server_credentials_set_auth_metadata_processor(credentials,
                                                        {&process_call, &forget_processor, new Processor(processor_)});
  const int bound = grpc_server_add_http2_port(server, address.c_str(), credentials);
  grpc_server_credentials_release(credentials);
  return bound;
}

}  // namespace cellcrush::access
