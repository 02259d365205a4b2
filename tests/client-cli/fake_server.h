#pragma once

#include <grpcpp/grpcpp.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"
#include "connection/frames.h"
#include "program.h"
#include "scripted_job.h"

namespace cellcrush::client::testing {

/// What the service was asked.
struct AskedOfSweeps {
  std::vector<v1::CreateSweepRequest> creates;
  std::vector<std::string> tokens;  ///< of the watches
  std::vector<v1::ListSweepsRequest> lists;
  std::vector<std::string> cancelled;
  std::vector<std::string> deleted;
  std::vector<std::string> retried;
};

/// What the server answers. Set it before the program under test runs.
struct Script {
  v1::Preset preset;
  v1::CheckCaseResponse check;
  grpc::Status create_status;
  int lost_creates = 0;              ///< so many answers of CreateJob and CreateSweep are lost
  v1::Job job;                       ///< known under its name; other names are NOT_FOUND
  std::vector<v1::JobEvent> events;  ///< behind the snapshot, with their sequence numbers
  int cut_streams = 0;               ///< so many watches end with UNAVAILABLE before the last event
  std::size_t events_before_cut = 3;
  bool hold = false;  ///< a watch stays open behind the last event
  std::vector<v1::Sample> samples;
  std::vector<MeshFrame> stages;   ///< ascending in strain; frames are sent in two parts
  std::string result;              ///< result.h5
  std::string page;                ///< of ExportJob; without one the job has not ended
  bool cut_export = false;         ///< whether it ends half way
  int cut_downloads = 0;           ///< so many downloads end half way
  bool damages_downloads = false;  ///< one byte is changed on the way
  bool changes_jobs = false;       ///< whether CancelJob and DeleteJob are there
  int message_limit = 0;           ///< bytes of a request it takes; 0 for gRPC's own limit
  SweepScript sweeps;
  std::optional<v1::Queue> queue;  ///< of GetQueue
  std::optional<v1::WhoAmIResponse> who;
  std::optional<v1::CompareTestResponse> difference;  ///< of CompareTest
};

/// What the server was asked.
struct Asked {
  std::vector<v1::CreateJobRequest> creates;
  std::vector<std::int64_t> after_sequences;
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> max_bytes;  ///< of ExportJob
  v1::Case checked;
  v1::CompareTestRequest compared;
  std::vector<v1::ListJobsRequest> lists;
  std::vector<std::string> cancelled;
  std::vector<std::string> deleted;
  AskedOfSweeps sweeps;
};

/// A server of all services on a Unix socket in a temporary folder of its own, which goes with it. What the script has
/// no answer for is UNIMPLEMENTED.
class FakeServer {
 public:
  explicit FakeServer(Script script);
  ~FakeServer();
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;

  [[nodiscard]] std::string address() const { return "unix:" + (folder() / "s").string(); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] Asked asked() const;

  /// Runs `cellcrush ARGUMENTS... --server ADDRESS` to its end.
  [[nodiscard]] ProgramResult run(std::vector<std::string> arguments, const std::string& input = {}) const;

 private:
  class Admin;
  class Cases;
  class Jobs;
  class Sweeps;
  struct Shared;

  cellcrush::testing::TemporaryFolder folder_;
  std::unique_ptr<Shared> shared_;
  std::unique_ptr<Cases> cases_;
  std::unique_ptr<Jobs> jobs_;
  std::unique_ptr<Sweeps> sweeps_;
  std::unique_ptr<Admin> admin_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace cellcrush::client::testing
