// Any bytes as calls of a client: a few of them, one after another, go through gRPC to the services of a daemon that
// runs no job and has something of everything (prepared_folder.h). Nothing may crash, hang, or be answered as a fault
// of the daemon; a refusal says what it refuses, shortly enough for a trailer. Whatever the calls change is undone
// before the next input, so that a find can be run again.
//
// Left out: cases of more than 2000 elements and sweeps of as many in all, for which the time is too short; running
// jobs, which tests/server and tests/faults have; and TLS and tokens, which are read before a message is.
#include <google/protobuf/stubs/logging.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <string>

#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "fuzz/prepared_folder.h"
#include "fuzz/size_bound.h"
#include "fuzz/wire_daemon.h"
#include "fuzz/wire_input.h"
#include "server/temporary_folder.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace cellcrush::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double kMostElements = 2000.0;

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
