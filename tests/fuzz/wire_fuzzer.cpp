// Any bytes as calls of a client: a few of them, one after another, go through gRPC to the services of a daemon that
// runs no job and has something of everything (prepared_folder.h). Nothing may crash, hang, or be answered as a fault
// of the daemon; a refusal says what it refuses, shortly enough for a trailer. Whatever the calls change is undone
// before the next input, so that a find can be run again.
//
// Left out: cases of more than 2000 elements and sweeps of as many in all, for which the time is too short; running
// jobs, which tests/server and tests/faults have; and TLS and tokens, which are read before a message is.
#include <google/protobuf/stubs/logging.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "access/gate.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "fuzz/prepared_folder.h"
#include "fuzz/size_bound.h"
#include "fuzz/wire_input.h"
#include "programs/temporary_folder.h"
#include "service.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace cellcrush::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double kMostElements = 2000.0;

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

// A daemon's Service on a data folder, without workers and reached over a channel within this process: calls pass
// gRPC's own reading of bytes as they do from outside.
class WireDaemon {
 public:
  explicit WireDaemon(const std::filesystem::path& data_folder)
      : service_(options_on(data_folder), gate_, kStepCost, [] {}) {
    grpc::ServerBuilder builder;
    builder.SetSyncServerOption(grpc::ServerBuilder::NUM_CQS, 1);
    service_.register_with(builder);
    server_ = builder.BuildAndStart();
    stub_ = std::make_unique<grpc::GenericStub>(server_->InProcessChannel({}));
  }

  // The service was not started: there are only watches to end.
  ~WireDaemon() {
    service_.stop();
    server_->Shutdown(std::chrono::system_clock::now() + kMinute);
    server_->Wait();
  }
  WireDaemon(const WireDaemon&) = delete;
  WireDaemon& operator=(const WireDaemon&) = delete;

  // How a call ended, and the bytes of its last message.
  struct Answer {
    grpc::Status status;
    std::string message;
  };

  // Makes a call of any kind, with any bytes as its message. A watch is broken off when it has nothing more to say for
  // now.
  Answer call(const std::string& method, const std::string& request, bool is_watch) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kMinute);
    grpc::CompletionQueue queue;
    const auto stream = stub_->PrepareCall(&context, method, &queue);
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

 private:
  access::Gate gate_{access::Options{}};
  Service service_;
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<grpc::GenericStub> stub_;
};

// A daemon on a copy of the prepared folder; a new one when calls have changed something.
class Bench {
 public:
  Bench() { prepare_folder(template_folder()); }

  WireDaemon& daemon() {
    if (daemon_) return *daemon_;
    fs::remove_all(data_folder());
    fs::create_directories(data_folder() / "jobs/2");
    fs::copy(template_folder() / "journal.sqlite", data_folder() / "journal.sqlite");
    // A result is only read or removed.
    fs::create_hard_link(template_folder() / "jobs/2/result.h5", data_folder() / "jobs/2/result.h5");
    daemon_ = std::make_unique<WireDaemon>(data_folder());
    return *daemon_;
  }

  void spoil() { daemon_.reset(); }

 private:
  [[nodiscard]] fs::path template_folder() const { return folder_.path() / "template"; }
  [[nodiscard]] fs::path data_folder() const { return folder_.path() / "data"; }

  testing::TemporaryFolder folder_;
  std::unique_ptr<WireDaemon> daemon_;
};

[[noreturn]] void give_up(const Method& method, const grpc::Status& status, const char* why) {
  std::fprintf(stderr, "%s: %s (%d, %s)\n", method.path().c_str(), why, status.error_code(),
               status.error_message().c_str());
  std::abort();
}

bool takes_long(const google::protobuf::Message& request) {
  if (const auto* check = dynamic_cast<const v1::CheckCaseRequest*>(&request))
    return is_large(check->case_(), kMostElements);
  if (const auto* create = dynamic_cast<const v1::CreateJobRequest*>(&request))
    return is_large(create->case_(), kMostElements);
  if (const auto* sweep = dynamic_cast<const v1::CreateSweepRequest*>(&request))
    return is_large(sweep->sweep(), kMostElements);
  return false;
}

void check_answer(const Method& method, const WireDaemon::Answer& answer) {
  constexpr std::size_t kMostTrailer = 8192;
  const auto& status = answer.status;
  switch (status.error_code()) {
    case grpc::StatusCode::OK: break;
    case grpc::StatusCode::CANCELLED:
      if (!method.is_watch()) give_up(method, status, "a call was broken off");
      break;
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::DATA_LOSS:
    case grpc::StatusCode::UNIMPLEMENTED:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      if (status.error_details().empty()) give_up(method, status, "a call failed");
      [[fallthrough]];
    default:
      if (status.error_message().empty()) give_up(method, status, "a refusal says nothing");
      // The message goes percent-encoded and the details in base64.
      if (3 * status.error_message().size() + status.error_details().size() * 4 / 3 > kMostTrailer)
        give_up(method, status, "a refusal is too long for a trailer");
  }
  const auto response = method.new_response();
  if (!response->ParseFromString(answer.message)) give_up(method, status, "an answer cannot be read");
  if (const auto* check = dynamic_cast<v1::CheckCaseResponse*>(response.get())) require_complete(check->problems());
}

bool leaves_all(const Method& method, const grpc::Status& status) {
  const std::string& name = method.descriptor->name();
  for (const char* only_reads : {"Get", "List", "Check", "Watch", "Download"}) {
    if (name.starts_with(only_reads)) return true;
  }
  return !status.ok();
}

// Whether all is as it was before.
bool run(Bench& bench, const WireCall& call) {
  const Method& method = methods()[call.method];
  const auto request = method.new_request();
  const bool is_message = request->ParseFromString(call.bytes);
  if (is_message && takes_long(*request)) return true;
  const auto answer = bench.daemon().call(method.path(), call.bytes, method.is_watch());
  if (is_message) check_answer(method, answer);
  if (!is_message && answer.status.ok()) give_up(method, answer.status, "what is no message was taken");
  return leaves_all(method, answer.status);
}

}  // namespace
}  // namespace cellcrush::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  spdlog::set_level(spdlog::level::off);
  google::protobuf::SetLogHandler(nullptr);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcrush::fuzz;
  static Bench bench;
  bool is_as_it_was = true;
  for (const auto& call : parse_calls(data, size)) is_as_it_was = run(bench, call) && is_as_it_was;
  if (!is_as_it_was) bench.spoil();
  return 0;
}

// Mostly sound messages with a field changed here and there; bytes at random would seldom get behind the reading of
// them.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace cellcrush::fuzz;
  std::mt19937 random(seed);
  auto calls = parse_calls(data, size);
  const auto draw = [&random](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  const std::size_t choice = calls.empty() ? 0 : draw(12);
  if (choice == 0) {
    calls.insert(calls.begin() + static_cast<std::ptrdiff_t>(draw(calls.size() + 1)), draw_call(random));
  } else if (choice == 1) {
    calls.erase(calls.begin() + static_cast<std::ptrdiff_t>(draw(calls.size())));
  } else if (choice == 2) {
    return LLVMFuzzerMutate(data, size, max_size);
  } else {
    WireCall& call = calls[draw(calls.size())];
    const auto request = methods()[call.method].new_request();
    if (!request->ParsePartialFromString(call.bytes)) return LLVMFuzzerMutate(data, size, max_size);
    for (std::size_t i = 0; i <= draw(3); ++i) mutate(*request, random);
    call.bytes = request->SerializeAsString();
  }
  const std::string out = bytes_of(calls);
  if (out.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(out.begin(), out.end(), data);
  return out.size();
}
