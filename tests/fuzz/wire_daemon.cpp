#include "fuzz/wire_daemon.h"

#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <utility>
#include <vector>

#include "access/gate.h"
#include "service.h"

namespace cellcrush::fuzz {
namespace {

constexpr double kStepCost = 1e-8;
constexpr std::chrono::milliseconds kQuiet{3};
constexpr std::chrono::seconds kMinute{60};

grpc::ByteBuffer buffer_of(const std::string& bytes) {
  const grpc::Slice slice(bytes);
  return {&slice, 1};
}

std::string bytes_of(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  std::string out;
  if (!buffer.Dump(&slices).ok()) return out;
  for (const auto& slice : slices) out.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return out;
}

// Waits for the one operation that is under way; whether it went well.
bool wait(grpc::CompletionQueue& queue) {
  void* tag = nullptr;
  bool ok = false;
  return queue.Next(&tag, &ok) && ok;
}

// The same for a message of a watch; the call is broken off when none comes soon.
bool wait_for_news(grpc::CompletionQueue& queue, grpc::ClientContext& context) {
  void* tag = nullptr;
  bool ok = false;
  if (queue.AsyncNext(&tag, &ok, std::chrono::system_clock::now() + kQuiet) == grpc::CompletionQueue::TIMEOUT) {
    context.TryCancel();
    return wait(queue);
  }
  return ok;
}

// A worker that is started by mistake ends at once.
DaemonOptions options_on(const std::filesystem::path& data_folder) {
  DaemonOptions out;
  out.data_folder = data_folder;
  out.workers = 2;
  out.worker_program = "/bin/false";
  out.watch_times.bookmark_interval = kMinute;
  return out;
}

}  // namespace

struct WireDaemon::Parts {
  explicit Parts(const std::filesystem::path& data_folder)
      : gate(access::Options{}), service(options_on(data_folder), gate, kStepCost, [] {}) {
    grpc::ServerBuilder builder;
    builder.SetSyncServerOption(grpc::ServerBuilder::NUM_CQS, 1);
    service.register_with(builder);
    server = builder.BuildAndStart();
    stub = std::make_unique<grpc::GenericStub>(server->InProcessChannel({}));
  }

  // The service was not started: there are only watches to end.
  ~Parts() {
    service.stop();
    server->Shutdown(std::chrono::system_clock::now() + kMinute);
    server->Wait();
  }

  access::Gate gate;
  Service service;
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<grpc::GenericStub> stub;
};

WireDaemon::WireDaemon(const std::filesystem::path& data_folder) : parts_(std::make_unique<Parts>(data_folder)) {}

WireDaemon::~WireDaemon() = default;

WireDaemon::Answer WireDaemon::call(const std::string& method, const std::string& request, bool is_watch) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kMinute);
  grpc::CompletionQueue queue;
  const auto stream = parts_->stub->PrepareCall(&context, method, &queue);
  stream->StartCall(nullptr);
  Answer out;
  if (wait(queue)) {
    stream->WriteLast(buffer_of(request), grpc::WriteOptions(), nullptr);
    static_cast<void>(wait(queue));
    grpc::ByteBuffer message;
    while (true) {
      stream->Read(&message, nullptr);
      if (!(is_watch ? wait_for_news(queue, context) : wait(queue))) break;
      out.message = bytes_of(message);
    }
  }
  stream->Finish(&out.status, nullptr);
  static_cast<void>(wait(queue));
  return out;
}

}  // namespace cellcrush::fuzz
