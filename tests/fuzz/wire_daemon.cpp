#include "fuzz/wire_daemon.h"

#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <utility>
#include <vector>

#include "access/gate.h"
#include "jobs/admission.h"
#include "jobs/local_process.h"
#include "jobs/scheduler.h"
#include "rpc/admin_service.h"
#include "rpc/cases_service.h"
#include "rpc/jobs_service.h"
#include "rpc/sweeps_service.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"
#include "watch/hub.h"
#include "watch/pump.h"

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

}  // namespace

// Members are in the order of their dependence, as in server/daemon.cpp.
struct WireDaemon::Parts {
  explicit Parts(const std::filesystem::path& data_folder)
      : gate(access::Options{}),
        folder(data_folder),
        journal(folder.journal(), [this](std::int64_t job) { hub.announce(job); }),
        reader(folder.journal()),
        sweep_reader(folder.journal()),
        executor("/bin/false", std::chrono::seconds(20)),
        runner({folder, journal, reader, hub, executor, metrics, kMinute, 0.0}),
        scheduler({folder, journal, reader, metrics, runner}),
        pump(1),
        admission(folder, {}),
        cases(kStepCost),
        jobs({folder, journal, reader, hub, pump, scheduler, admission, metrics, gate, kMinute}),
        sweeps({journal, reader, sweep_reader, hub, pump, scheduler, admission, metrics, gate, kMinute}),
        admin({reader, hub, scheduler, {2, kStepCost, false}, gate, [this] { admission.drain(); }}) {
    grpc::ServerBuilder builder;
    builder.SetSyncServerOption(grpc::ServerBuilder::NUM_CQS, 1);
    for (grpc::Service* service : std::initializer_list<grpc::Service*>{&cases, &jobs, &sweeps, &admin})
      builder.RegisterService(service);
    server = builder.BuildAndStart();
    stub = std::make_unique<grpc::GenericStub>(server->InProcessChannel({}));
  }

  ~Parts() {
    pump.drain();
    server->Shutdown(std::chrono::system_clock::now() + kMinute);
    server->Wait();
  }

  access::Gate gate;
  store::DataFolder folder;
  watch::Hub hub;
  metrics::Metrics metrics;
  store::Journal journal;
  store::JournalReader reader;
  store::SweepReader sweep_reader;
  jobs::LocalProcess executor;
  jobs::JobRunner runner;
  jobs::Scheduler scheduler;
  watch::Pump pump;
  jobs::Admission admission;
  rpc::CasesService cases;
  rpc::JobsService jobs;
  rpc::SweepsService sweeps;
  rpc::AdminService admin;
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
