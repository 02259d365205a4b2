#include "rpc/method_table.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "access/call_backlog.h"
#include "error.h"
#include "error_table.h"
#include "net/connection_table.h"
#include "rpc/request_fields.h"

namespace cellcrush::rpc {
namespace {

// Calls of one caller that wait for their requests to be read.
constexpr std::size_t kMostWaiting = 2'000;
constexpr std::size_t kMostWaitingOfStrangers = 200;  // of an address

// The error of a request that cannot be parsed, naming the method and the message type. `path` is as gRPC has it.
InvalidField parse_error(std::string_view path) {
  std::string method(path.substr(path.starts_with('/') ? 1 : 0));
  std::replace(method.begin(), method.end(), '/', '.');
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(method);
  const std::string type =
      descriptor == nullptr ? "message of the expected type" : descriptor->input_type()->full_name();
  return {"request", "of " + method + " is not a " + type + ": its bytes cannot be parsed, or a string is not UTF-8.",
          "Encode it with this server's .proto files, and every string as UTF-8."};
}

// "Jobs/CreateJob".
std::string label_of(const google::protobuf::MethodDescriptor& method) {
  return method.service()->name() + "/" + method.name();
}

}  // namespace

std::int64_t MethodTable::UnaryReactor::set_answer(const google::protobuf::Message& answer) {
  answer_ = wire_of(answer);
  return static_cast<std::int64_t>(answer_.Length());
}

void MethodTable::UnaryReactor::on_request(grpc::ByteBuffer& bytes, std::shared_ptr<Accounts::Charge> received) {
  Arrived arrived;
  arrived.incoming = incoming_of(bytes);
  arrived.incoming.received = std::move(received);
  arrived.is_small = arrived.incoming.bytes <= kLightRequest;
  arrived.task.call = std::static_pointer_cast<UnaryReactor>(shared_from_this());
  arrived.task.caller = caller_name();
  arrived.task.finish = [this](const grpc::Status& status, std::shared_ptr<Accounts::Charge> charge) {
    finish(status, std::move(charge));
  };
  begin_(std::move(arrived), *this);
}

void MethodTable::UnaryReactor::finish(const grpc::Status& status, std::shared_ptr<Accounts::Charge> charge) {
  charge_ = std::move(charge);
  if (!status.ok()) return end(status);
  limit_end(std::chrono::milliseconds(answer_.Length() / 100));
  note_end(status);
  StartWriteAndFinish(&answer_, {}, status);
}

void MethodTable::UnaryCall::ask(Deliver deliver) {
  const auto answer = std::make_shared<Batch>();
  CallPool::Task task{.call = shared_from_this(), .caller = incoming_.caller.name};
  task.finish = [answer, deliver = std::move(deliver)](const grpc::Status& status,
                                                       std::shared_ptr<Accounts::Charge> charge) {
    answer->end = status;
    answer->charge = std::move(charge);
    deliver(std::move(*answer));
  };
  Incoming incoming{incoming_.caller,
                    incoming_.epoch,
                    std::exchange(incoming_.decode, nullptr),
                    incoming_.bytes,
                    std::exchange(incoming_.received, nullptr),
                    incoming_.encode};
  begin_({std::move(task), std::move(incoming)}, answer->bytes);
}

const MethodTable::Method* MethodTable::find(std::string_view path) const {
  const auto found = methods_.find(path);
  return found == methods_.end() ? nullptr : &found->second;
}

void MethodTable::read_into(google::protobuf::Message& request, const char* path, const Incoming& incoming) {
  if (!incoming.decode(request)) throw parse_error(path);
  const auto bytes = static_cast<std::int64_t>(request.ByteSizeLong());
  if (bytes > kLargestMessage) throw too_large(bytes, kLargestMessage);
}

std::string MethodTable::exchange_epochs(grpc::CallbackServerContext& context) const {
  context.AddInitialMetadata(kEpochHeader, epoch_.id);
  const auto found = context.client_metadata().find(kEpochHeader);
  if (found == context.client_metadata().end()) return "";
  std::string named(found->second.data(), found->second.size());
  // Python's asyncio may drop the initial metadata of a refused stream.
  if (named != epoch_.id) context.AddTrailingMetadata(kEpochHeader, epoch_.id);
  return named;
}

void MethodTable::require_epoch(const std::string& named) const {
  if (named.empty() || named == epoch_.id) return;
  const std::string shown = named.substr(0, std::min<std::size_t>(named.find_first_not_of("0123456789abcdef"), 32));
  throw ServiceError(
      ServiceError::Kind::failed_precondition,
      "This is another server, or another data folder, than the one that the call is meant for: the call names epoch " +
          shown + ", this server has epoch " + epoch_.id +
          (epoch_.restored.empty() ? "" : ", since the restore of " + epoch_.restored) +
          ". Its jobs are others, even under the same names. Nothing was changed. List its jobs before you change "
          "any.");
}

ServiceError MethodTable::too_large(std::int64_t bytes, std::int64_t most) {
  return {ServiceError::Kind::exhausted,
          "The request has " + std::to_string(bytes) + " bytes. Use at most " + std::to_string(most) + "."};
}

Incoming MethodTable::incoming_of(grpc::ByteBuffer& bytes) {
  Incoming out;
  out.bytes = static_cast<std::int64_t>(bytes.Length());
  const auto own = std::make_shared<grpc::ByteBuffer>();
  bytes.Swap(own.get());
  out.decode = [own](google::protobuf::Message& request) {
    grpc::Slice whole;
    if (!own->DumpToSingleSlice(&whole).ok()) return false;
    own->Clear();
    return parse_within_limits({reinterpret_cast<const char*>(whole.begin()), whole.size()}, request);
  };
  return out;
}

std::string MethodTable::name_of(const grpc::CallbackServerContext& context, const std::string& connection,
                                 bool is_open) const {
  if (is_open) {
    const auto local = gate_.local_caller_of(*context.auth_context());
    return local ? local->name : net::peer_of_name(connection);
  }
  auto out = gate_.caller_of(context).name;
  if (on_admitted) on_admitted(connection, out);
  return out;
}

grpc::ServerGenericBidiReactor* MethodTable::CreateReactor(grpc::GenericCallbackServerContext* context) {
  using Refused = RefusedStream<grpc::ServerGenericBidiReactor>;
  const std::string connection = context->peer();
  const auto key = gate_.key_of(*context->auth_context());
  gate_.backlog().begin(key, connection);
  const Method* method = find(context->method());
  if (method == nullptr) {
    note_end(context->method(), grpc::StatusCode::UNIMPLEMENTED);
    return new Refused({grpc::StatusCode::UNIMPLEMENTED, "This server has no method " + context->method() + "."});
  }
  try {
    const auto epoch = exchange_epochs(*context);
    const bool is_small = method->is_open || method->descriptor->server_streaming();
    const std::chrono::milliseconds more((is_small ? kLargestStreamRequest : kLargestMessage) / 100);
    const auto reactor =
        method->serve(*context, name_of(*context, connection, method->is_open), {patience_ + more, patience_});
    require_epoch(epoch);
    reactor->on_end([watch = CallWatch(*this, *method)](grpc::StatusCode code) { watch.end(code); });
    open_calls_.add(reactor, method->is_open ? kMostWaitingOfStrangers : kMostWaiting);
    return reactor.get();
  } catch (const std::exception& error) {
    const auto status = status_of(error);
    if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) gate_.backlog().refuse(key);
    note_end(context->method(), status.error_code());
    return new Refused(status);
  }
}

void MethodTable::start(const CallPool* pool, CallPool::Task task, bool is_small) {
  if (pool != nullptr) {
    // To wake two threads one after the other takes longer than to parse a small request.
    if (is_small && pool != &calls_ && calls_.run_at_once(task)) return;
    return calls_.run(std::move(task));
  }
  task.charge = std::make_shared<Accounts::Charge>(received_, task.caller, 0);
  CallPool::run_here(std::move(task));
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
  method.label = label_of(*method.descriptor);
  const auto added = methods_.emplace(path, std::move(method)).first;
  Method& kept = added->second;
  kept.open = [this, &kept, open = std::move(kept.open)](const Incoming& incoming) -> std::shared_ptr<MessageStream> {
    const CallWatch watch(*this, kept);
    try {
      require_epoch(incoming.epoch);
      return std::make_shared<WatchedStream>(open(incoming), watch);
    } catch (const std::exception& error) {
      watch.end(status_of(error).error_code());
      throw;
    }
  };
}

void MethodTable::note_end(std::string_view path, grpc::StatusCode code, std::optional<double> seconds) const {
  if (!on_ended) return;
  const Method* method = find(path);
  on_ended({method == nullptr ? "unknown" : method->label, code, seconds});
}

void MethodTable::CallWatch::end(grpc::StatusCode code) const {
  if (!table_->on_ended) return;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
  const bool is_stream = method_->descriptor->server_streaming();
  table_->on_ended({method_->label, code, is_stream ? std::nullopt : std::optional(taken.count())});
}

MethodTable::WatchedStream::~WatchedStream() {
  if (!has_ended_) watch_.end(grpc::StatusCode::CANCELLED);
}

void MethodTable::WatchedStream::ask(Deliver deliver) {
  stream_->ask([self = shared_from_this(), deliver = std::move(deliver)](Batch batch) {
    if (batch.end && !self->has_ended_.exchange(true)) self->watch_.end(batch.end->error_code());
    deliver(std::move(batch));
  });
}

}  // namespace cellcrush::rpc
