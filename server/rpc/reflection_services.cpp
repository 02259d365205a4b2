#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <set>
#include <utility>

#include "access/call_backlog.h"
#include "error_table.h"
#include "grpc/reflection/v1/reflection.grpc.pb.h"
#include "grpc/reflection/v1alpha/reflection.grpc.pb.h"
#include "log_format.h"
#include "rpc/services.h"

namespace cellcrush::rpc {
namespace {

using google::protobuf::DescriptorPool;
using google::protobuf::FileDescriptor;

// The messages of one version; both versions have the same fields.
struct ReflectionV1 {
  using Service = grpc::reflection::v1::ServerReflection;
  using Request = grpc::reflection::v1::ServerReflectionRequest;
  using Response = grpc::reflection::v1::ServerReflectionResponse;
};
struct ReflectionV1Alpha {
  using Service = grpc::reflection::v1alpha::ServerReflection;
  using Request = grpc::reflection::v1alpha::ServerReflectionRequest;
  using Response = grpc::reflection::v1alpha::ServerReflectionResponse;
};

template <class Response>
void refuse(Response& response, grpc::StatusCode code, const std::string& why) {
  response.mutable_error_response()->set_error_code(code);
  response.mutable_error_response()->set_error_message(printable(why));
}

template <class Files>
void add_file(const FileDescriptor& file, std::set<const FileDescriptor*>& added, Files& files) {
  if (!added.insert(&file).second) return;
  google::protobuf::FileDescriptorProto proto;
  file.CopyTo(&proto);
  files.add_file_descriptor_proto(proto.SerializeAsString());
  for (int i = 0; i < file.dependency_count(); ++i) add_file(*file.dependency(i), added, files);
}

// `file` is null if there is none.
template <class Response>
void answer_file(const FileDescriptor* file, const std::string& name, Response& response) {
  if (file == nullptr) return refuse(response, grpc::StatusCode::NOT_FOUND, "This server has no " + name + ".");
  std::set<const FileDescriptor*> added;
  add_file(*file, added, *response.mutable_file_descriptor_response());
}

template <class Response>
void answer_extension(const std::string& type, int number, Response& response) {
  const auto* pool = DescriptorPool::generated_pool();
  const auto* message = pool->FindMessageTypeByName(type);
  const auto* extension = message == nullptr ? nullptr : pool->FindExtensionByNumber(message, number);
  answer_file(extension == nullptr ? nullptr : extension->file(), "extension " + std::to_string(number) + " of " + type,
              response);
}

template <class Response>
void answer_extension_numbers(const std::string& type, Response& response) {
  const auto* pool = DescriptorPool::generated_pool();
  const auto* message = pool->FindMessageTypeByName(type);
  if (message == nullptr)
    return refuse(response, grpc::StatusCode::NOT_FOUND, "This server has no message " + type + ".");
  std::vector<const google::protobuf::FieldDescriptor*> extensions;
  pool->FindAllExtensions(message, &extensions);
  std::set<int> numbers;
  for (const auto* extension : extensions) numbers.insert(extension->number());
  auto& answer = *response.mutable_all_extension_numbers_response();
  answer.set_base_type_name(type);
  for (const int number : numbers) answer.add_extension_number(number);
}

template <class Version>
typename Version::Response answer_reflection(const typename Version::Request& request,
                                             const std::vector<std::string>& names) {
  const auto* pool = DescriptorPool::generated_pool();
  typename Version::Response response;
  response.set_valid_host(request.host());
  *response.mutable_original_request() = request;
  switch (request.message_request_case()) {
    case Version::Request::kFileByFilename:
      answer_file(pool->FindFileByName(request.file_by_filename()), "file " + request.file_by_filename(), response);
      break;
    case Version::Request::kFileContainingSymbol:
      answer_file(pool->FindFileContainingSymbol(request.file_containing_symbol()), request.file_containing_symbol(),
                  response);
      break;
    case Version::Request::kFileContainingExtension:
      answer_extension(request.file_containing_extension().containing_type(),
                       request.file_containing_extension().extension_number(), response);
      break;
    case Version::Request::kAllExtensionNumbersOfType:
      answer_extension_numbers(request.all_extension_numbers_of_type(), response);
      break;
    case Version::Request::kListServices:
      for (const auto& name : names) response.mutable_list_services_response()->add_service()->set_name(name);
      break;
    case Version::Request::MESSAGE_REQUEST_NOT_SET:
      refuse(response, grpc::StatusCode::INVALID_ARGUMENT, "The request is empty. Set one field of message_request.");
      break;
  }
  return response;
}

template <class Version>
using Reactor = grpc::ServerBidiReactor<typename Version::Request, typename Version::Response>;

// One stream: answers requests until the client sends no more.
template <class Version>
class ReflectionStream final : public Reactor<Version> {
 public:
  ReflectionStream(const std::vector<std::string>& names, StreamLimits::Permit permit)
      : names_(names), permit_(std::move(permit)) {
    this->StartRead(&request_);
  }

  void OnReadDone(bool is_read) override {
    if (!is_read) return this->Finish(grpc::Status::OK);
    response_ = answer_reflection<Version>(request_, names_);
    this->StartWrite(&response_);
  }

  void OnWriteDone(bool is_written) override {
    if (!is_written) return this->Finish(grpc::Status::CANCELLED);
    this->StartRead(&request_);
  }

  void OnDone() override { delete this; }

 private:
  const std::vector<std::string>& names_;
  StreamLimits::Permit permit_;
  typename Version::Request request_;
  typename Version::Response response_;
};

template <class Version>
class ReflectionService final : public Version::Service::CallbackService {
 public:
  ReflectionService(std::vector<std::string> names, const access::Gate& gate, StreamLimits& limits)
      : names_(std::move(names)), gate_(gate), limits_(limits) {}

  Reactor<Version>* ServerReflectionInfo(grpc::CallbackServerContext* context) override {
    gate_.backlog().begin(gate_.key_of(*context->auth_context()), context->peer());
    try {
      return new ReflectionStream<Version>(names_, limits_.admit(gate_.caller_of(*context).name));
    } catch (const ServiceError& error) {
      return new RefusedStream<Reactor<Version>>(status_of(error));
    }
  }

 private:
  std::vector<std::string> names_;
  const access::Gate& gate_;
  StreamLimits& limits_;
};

}  // namespace

std::vector<std::unique_ptr<grpc::Service>> make_reflection_services(std::vector<std::string> names, access::Gate& gate,
                                                                     StreamLimits& limits) {
  names.emplace_back(ReflectionV1::Service::service_full_name());
  names.emplace_back(ReflectionV1Alpha::Service::service_full_name());
  for (const auto* name : {ReflectionV1::Service::service_full_name(), ReflectionV1Alpha::Service::service_full_name()})
    gate.guard("/" + std::string(name) + "/ServerReflectionInfo", access::Scope::read);
  std::sort(names.begin(), names.end());
  std::vector<std::unique_ptr<grpc::Service>> out;
  out.push_back(std::make_unique<ReflectionService<ReflectionV1>>(names, gate, limits));
  out.push_back(std::make_unique<ReflectionService<ReflectionV1Alpha>>(std::move(names), gate, limits));
  return out;
}

}  // namespace cellcrush::rpc
