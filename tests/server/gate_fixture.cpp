#include "server/gate_fixture.h"

#include <grpcpp/support/client_interceptor.h>

#include <utility>

#include "access/token_file.h"
#include "error.h"

namespace cellcrush::testing {
namespace {

using Scope = access::Scope;

// Adds a token to the calls of a channel without TLS, for which gRPC itself refuses to.
struct TokenBearer : grpc::experimental::Interceptor, grpc::experimental::ClientInterceptorFactoryInterface {
  explicit TokenBearer(std::string bearer_token) : token(std::move(bearer_token)) {}
  grpc::experimental::Interceptor* CreateClientInterceptor(grpc::experimental::ClientRpcInfo*) override {
    return new TokenBearer(token);
  }
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(grpc::experimental::InterceptionHookPoints::PRE_SEND_INITIAL_METADATA))
      methods->GetSendInitialMetadata()->emplace("authorization", "Bearer " + token);
    methods->Proceed();
  }
  std::string token;
};

}  // namespace

void GateFixture::SetUp() {
  std::string lines = "# who may call\n\n";
  for (const auto& [name, scope] : {std::pair("reader", Scope::read), std::pair("anna", Scope::submit),
                                    std::pair("bob", Scope::submit), std::pair("chief", Scope::admin)}) {
    const auto made = access::make_token(name, scope);
    tokens_[name] = made.token;
    lines += "  " + made.line + " # until spring\r\n";
  }
  write_secret(folder_.path() / "tokens", lines);
}

DaemonOptions GateFixture::tcp_options(const std::string& address) const {
  DaemonOptions options = default_options();
  options.listen.push_back(address);
  return options;
}

DaemonOptions GateFixture::with_tokens(DaemonOptions options) const {
  options.access.tokens = folder_.path() / "tokens";
  return options;
}

DaemonOptions GateFixture::with_tls(DaemonOptions options, const CertificateRequest& request) const {
  const auto server = authority_.sign("server", request);
  options.access.tls_certificate = server.certificate;
  options.access.tls_key = server.key;
  return options;
}

std::string GateFixture::refusal_of_start(const DaemonOptions& options) {
  try {
    start(options);
  } catch (const ServiceError& refused) {
    return refused.what();
  }
  return "";
}

std::shared_ptr<grpc::Channel> GateFixture::channel(const Visitor& visitor, const std::string& host) const {
  auto credentials = grpc::InsecureChannelCredentials();
  if (!visitor.authority.empty()) {
    grpc::SslCredentialsOptions options;
    options.pem_root_certs = text_of_file(visitor.authority);
    options.pem_cert_chain = text_of_file(visitor.shown.certificate);
    options.pem_private_key = text_of_file(visitor.shown.key);
    credentials = grpc::SslCredentials(options);
    if (!visitor.token.empty())
      credentials = grpc::CompositeChannelCredentials(credentials, grpc::AccessTokenCredentials(visitor.token));
  }
  const std::string& address = daemon_->addresses().back();
  return grpc::CreateChannel(host + address.substr(address.rfind(':')), credentials);
}

Client GateFixture::client_of(const std::string& name) const {
  std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> creators;
  creators.push_back(std::make_unique<TokenBearer>(tokens_.at(name)));
  return Client(grpc::experimental::CreateCustomChannelWithInterceptors(
      daemon_->addresses().back(), grpc::InsecureChannelCredentials(), {}, std::move(creators)));
}

std::unique_ptr<grpc::ClientContext> GateFixture::context_of(const Visitor& visitor) {
  auto out = bounded_context(std::chrono::seconds(10));
  if (visitor.authority.empty() && !visitor.token.empty()) out->AddMetadata("authorization", "Bearer " + visitor.token);
  return out;
}

grpc::Status GateFixture::list(const Visitor& visitor, const std::string& host) const {
  const auto jobs = v1::Jobs::NewStub(channel(visitor, host));
  v1::ListJobsResponse response;
  return jobs->ListJobs(context_of(visitor).get(), {}, &response);
}

Visitor GateFixture::with(const std::string& name) const { return {authority_.certificate(), {}, tokens_.at(name)}; }

}  // namespace cellcrush::testing
