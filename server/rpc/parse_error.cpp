#include "rpc/parse_error.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "error_table.h"

namespace cellcrush::rpc {

InvalidField parse_error(std::string_view path) {
  std::string method(path.substr(path.starts_with('/') ? 1 : 0));
  std::replace(method.begin(), method.end(), '/', '.');
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(method);
  const std::string type =
      descriptor == nullptr ? "message of the expected type" : descriptor->input_type()->full_name();
  return {"request", "of " + method + " is not a " + type + ": its bytes cannot be parsed, or a string is not UTF-8.",
          "Encode it with this server's .proto files, and every string as UTF-8."};
}

namespace {

namespace grpc_hooks = grpc::experimental;

class ParseErrorInterceptor final : public grpc_hooks::Interceptor {
 public:
  explicit ParseErrorInterceptor(const char* path) : path_(path) {}

  void Intercept(grpc_hooks::InterceptorBatchMethods* methods) override {
    using Point = grpc_hooks::InterceptionHookPoints;
    if (methods->QueryInterceptionHookPoint(Point::POST_RECV_MESSAGE))
      has_message_ = methods->GetRecvMessage() != nullptr;
    if (!has_message_ && methods->QueryInterceptionHookPoint(Point::PRE_SEND_STATUS)) {
      const auto code = methods->GetSendStatus().error_code();
      if (code == grpc::StatusCode::INTERNAL || code == grpc::StatusCode::UNIMPLEMENTED)
        methods->ModifySendStatus(status_of(parse_error(path_)));
    }
    methods->Proceed();
  }

 private:
  const char* path_;
  bool has_message_ = true;
};

class ParseErrorInterceptors final : public grpc_hooks::ServerInterceptorFactoryInterface {
 public:
  // gRPC owns the returned object. A stream of requests has no single message to check.
  grpc_hooks::Interceptor* CreateServerInterceptor(grpc_hooks::ServerRpcInfo* info) override {
    using Type = grpc_hooks::ServerRpcInfo::Type;
    const bool has_one_request = info->type() == Type::UNARY || info->type() == Type::SERVER_STREAMING;
    return has_one_request ? new ParseErrorInterceptor(info->method()) : nullptr;
  }
};

}  // namespace

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_parse_error_interceptors() {
  return std::make_unique<ParseErrorInterceptors>();
}

}  // namespace cellcrush::rpc
