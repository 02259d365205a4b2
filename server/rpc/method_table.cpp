#include "rpc/method_table.h"

#include <algorithm>

#include "error.h"
#include "error_table.h"
#include "rpc/parse_error.h"
#include "rpc/request_limits.h"

namespace cellcrush::rpc {

void MethodTable::UnaryCall::ask(Deliver deliver) {
  const auto answer = std::make_shared<Batch>();
  const auto self = shared_from_this();
  run(pool_, {self, bytes_, [self, answer] { return self->body_(*self, answer->bytes); },
              [answer, deliver = std::move(deliver)](const grpc::Status& status) {
                answer->end = status;
                deliver(std::move(*answer));
              }});
}

const MethodTable::Method* MethodTable::find(std::string_view path) const {
  const auto found = methods_.find(path);
  return found == methods_.end() ? nullptr : &found->second;
}

void MethodTable::read_into(google::protobuf::Message& request, const char* path, const Incoming& incoming) {
  if (!incoming.decode(request)) throw parse_error(path);
  if (request.ByteSizeLong() <= static_cast<std::size_t>(kLargestMessage)) return;
  throw ServiceError(ServiceError::Kind::exhausted, "The request has " + std::to_string(request.ByteSizeLong()) +
                                                        " bytes. Use at most " + std::to_string(kLargestMessage) + ".");
}

void MethodTable::run(CallPool* pool, CallPool::Task task) {
  pool != nullptr ? pool->run(std::move(task)) : task.finish(answer(task.body));
}

// "ipv4:127.0.0.1" of "ipv4:127.0.0.1:40312".
std::string MethodTable::address_of(const std::string& peer) {
  return peer.starts_with("unix:") ? "unix" : peer.substr(0, peer.rfind(':'));
}

const google::protobuf::MethodDescriptor* MethodTable::describe(std::string_view path,
                                                                const google::protobuf::Descriptor& request,
                                                                const google::protobuf::Descriptor& response,
                                                                bool is_stream) {
  std::string name(path.substr(1));
  std::replace(name.begin(), name.end(), '/', '.');
  const auto* out = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(name);
  if (out == nullptr || out->input_type() != &request || out->output_type() != &response || out->client_streaming() ||
      out->server_streaming() != is_stream)
    throw ServiceError(ServiceError::Kind::internal, "No .proto file has the method " + std::string(path) + ".");
  return out;
}

void MethodTable::add(const char* path, std::optional<access::Scope> scope, Method method) {
  gate_.guard(path, scope);
  methods_.emplace(path, std::move(method));
}

}  // namespace cellcrush::rpc
