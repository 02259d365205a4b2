#include "fake_server.h"

#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

namespace cellcrush::client::testing {

namespace {

grpc::Status not_found(const std::string& name) { return {grpc::StatusCode::NOT_FOUND, "there is no " + name}; }

// As the client says itself when nothing comes.
const grpc::Status kLost{grpc::StatusCode::DEADLINE_EXCEEDED, "Deadline Exceeded"};

}  // namespace

struct FakeServer::Shared {
  Script script;
  mutable std::mutex mutex;  ///< guards `asked` and the counters of the script
  Asked asked;

  bool loses_answer() {
    const std::lock_guard lock(mutex);
    return script.lost_creates-- > 0;
  }

  // Notes what a service was asked.
  template <typename Value>
  void note(std::vector<Value> Asked::*list, const Value& value) {
    const std::lock_guard lock(mutex);
    (asked.*list).push_back(value);
  }
  template <typename Value>
  void note(std::vector<Value> AskedOfSweeps::*list, const Value& value) {
    const std::lock_guard lock(mutex);
    (asked.sweeps.*list).push_back(value);
  }
};

class FakeServer::Cases : public v1::Cases::Service {
 public:
  explicit Cases(Shared& shared) : shared_(shared) {}

  grpc::Status CheckCase(grpc::ServerContext*, const v1::CheckCaseRequest* request,
                         v1::CheckCaseResponse* response) override {
    const std::lock_guard lock(shared_.mutex);
    shared_.asked.checked = request->case_();
    *response = shared_.script.check;
    return grpc::Status::OK;
  }

  grpc::Status ListPresets(grpc::ServerContext*, const v1::ListPresetsRequest*,
                           v1::ListPresetsResponse* response) override {
    v1::Preset& preset = *response->add_presets();
    preset.set_name(shared_.script.preset.name());
    preset.set_title(shared_.script.preset.title());
    return grpc::Status::OK;
  }

  grpc::Status ListMaterials(grpc::ServerContext*, const v1::ListMaterialsRequest*,
                             v1::ListMaterialsResponse* response) override {
    v1::NamedMaterial& material = *response->add_materials();
    material.set_name("Al 1");
    material.set_title("Aluminium of the tests");
    material.set_numbers("E 69000 MPa");
    material.add_sources("E: a handbook.");
    return grpc::Status::OK;
  }

  grpc::Status GetPreset(grpc::ServerContext*, const v1::GetPresetRequest* request, v1::Preset* response) override {
    if (request->name() != shared_.script.preset.name()) return not_found("preset " + request->name());
    *response = shared_.script.preset;
    return grpc::Status::OK;
  }

 private:
  Shared& shared_;
};

class FakeServer::Jobs : public v1::Jobs::Service {
 public:
  explicit Jobs(Shared& shared) : shared_(shared) {}

  grpc::Status CreateJob(grpc::ServerContext*, const v1::CreateJobRequest* request, v1::Job* response) override {
    shared_.note(&Asked::creates, *request);
    *response = shared_.script.job;
    return shared_.loses_answer() ? kLost : shared_.script.create_status;
  }

  grpc::Status GetJob(grpc::ServerContext*, const v1::GetJobRequest* request, v1::Job* response) override {
    if (!knows(request->name())) return not_found(request->name());
    *response = shared_.script.job;
    return grpc::Status::OK;
  }

  grpc::Status ListJobs(grpc::ServerContext*, const v1::ListJobsRequest* request,
                        v1::ListJobsResponse* response) override {
    shared_.note(&Asked::lists, *request);
    *response->add_jobs() = shared_.script.job;
    if (request->page_token().empty()) response->set_next_page_token("second");
    return grpc::Status::OK;
  }

  grpc::Status CancelJob(grpc::ServerContext*, const v1::CancelJobRequest* request, v1::Job* response) override {
    if (!shared_.script.changes_jobs) return {grpc::StatusCode::UNIMPLEMENTED, ""};
    if (!knows(request->name())) return not_found(request->name());
    shared_.note(&Asked::cancelled, request->name());
    *response = shared_.script.job;
    response->set_state(v1::Job::CANCELLING);
    return grpc::Status::OK;
  }

  grpc::Status DeleteJob(grpc::ServerContext*, const v1::DeleteJobRequest* request, v1::DeleteJobResponse*) override {
    if (!shared_.script.changes_jobs) return {grpc::StatusCode::UNIMPLEMENTED, ""};
    if (!knows(request->name())) return not_found(request->name());
    shared_.note(&Asked::deleted, request->name());
    return grpc::Status::OK;
  }

  grpc::Status WatchJob(grpc::ServerContext* context, const v1::WatchJobRequest* request,
                        grpc::ServerWriter<v1::JobEvent>* writer) override {
    if (!knows(request->name())) return not_found(request->name());
    const bool cut = note_watch(request->after_sequence());
    v1::JobEvent event;
    event.set_sequence(request->after_sequence());
    *event.mutable_snapshot()->mutable_job() = shared_.script.job;
    writer->Write(event);
    std::size_t sent = 0;
    for (const v1::JobEvent& next : shared_.script.events) {
      if (next.sequence() <= request->after_sequence()) continue;
      if (cut && sent == shared_.script.events_before_cut)
        return {grpc::StatusCode::UNAVAILABLE, "the script cuts here"};
      writer->Write(next);
      ++sent;
    }
    while (shared_.script.hold && !context->IsCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return cut ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the script cuts here") : grpc::Status::OK;
  }

  grpc::Status GetHistory(grpc::ServerContext*, const v1::GetHistoryRequest* request,
                          v1::GetHistoryResponse* response) override {
    if (!knows(request->name())) return not_found(request->name());
    // A token is the number of samples before it.
    constexpr std::size_t kPage = 150;
    const auto& samples = shared_.script.samples;
    std::size_t at = request->page_token().empty() ? 0 : std::stoul(request->page_token());
    const std::size_t end = std::min(samples.size(), at + kPage);
    while (at < end) *response->add_samples() = samples[at++];
    if (end < samples.size()) response->set_next_page_token(std::to_string(end));
    return grpc::Status::OK;
  }

  grpc::Status CompareTest(grpc::ServerContext*, const v1::CompareTestRequest* request,
                           v1::CompareTestResponse* response) override {
    const std::lock_guard lock(shared_.mutex);
    if (!shared_.script.difference) return {grpc::StatusCode::UNIMPLEMENTED, ""};
    shared_.asked.compared = *request;
    *response = *shared_.script.difference;
    return grpc::Status::OK;
  }

  grpc::Status GetFrame(grpc::ServerContext*, const v1::GetFrameRequest* request,
                        grpc::ServerWriter<v1::GetFrameResponse>* writer) override {
    if (!knows(request->name()) || shared_.script.stages.empty()) return not_found(request->name());
    const MeshFrame& stage = find_stage(*request);
    v1::GetFrameResponse first;
    *first.mutable_mesh()->mutable_mesh() = stage.mesh;
    *first.mutable_chunk()->mutable_frame() = stage.frame;
    first.mutable_chunk()->mutable_frame()->clear_plastic_fraction();
    first.mutable_chunk()->set_part_count(2);
    writer->Write(first);
    v1::GetFrameResponse second;
    *second.mutable_chunk()->mutable_frame()->mutable_plastic_fraction() = stage.frame.plastic_fraction();
    second.mutable_chunk()->set_part(1);
    second.mutable_chunk()->set_part_count(2);
    writer->Write(second);
    return grpc::Status::OK;
  }

  grpc::Status DownloadResult(grpc::ServerContext*, const v1::DownloadResultRequest* request,
                              grpc::ServerWriter<v1::DownloadResultResponse>* writer) override {
    constexpr std::size_t kChunk = 1000;
    if (shared_.script.result.empty()) return {grpc::StatusCode::FAILED_PRECONDITION, "the job has no result yet"};
    const std::string& file = shared_.script.result;
    std::size_t end = file.size();
    {
      const std::lock_guard lock(shared_.mutex);
      shared_.asked.offsets.push_back(request->offset());
      if (shared_.script.cut_downloads-- > 0) end = file.size() / 2;
    }
    for (auto at = static_cast<std::size_t>(request->offset()); at < end; at += kChunk) {
      v1::DownloadResultResponse chunk;
      chunk.set_offset(static_cast<std::int64_t>(at));
      chunk.set_data(file.substr(at, std::min(kChunk, end - at)));
      const auto* begin = reinterpret_cast<const unsigned char*>(file.data());
      chunk.set_crc32(static_cast<std::uint32_t>(crc32_z(0, begin, at + chunk.data().size())));
      if (shared_.script.damages_downloads) chunk.mutable_data()->front() ^= 1;
      chunk.set_total_size(static_cast<std::int64_t>(file.size()));
      writer->Write(chunk);
    }
    return end == file.size() ? grpc::Status::OK : grpc::Status(grpc::StatusCode::UNAVAILABLE, "the script cuts here");
  }

  grpc::Status ExportJob(grpc::ServerContext*, const v1::ExportJobRequest* request,
                         grpc::ServerWriter<v1::ExportJobResponse>* writer) override {
    const std::string& page = shared_.script.page;
    if (page.empty()) return {grpc::StatusCode::FAILED_PRECONDITION, "jobs/test is RUNNING. Wait until it has ended."};
    shared_.note(&Asked::max_bytes, static_cast<std::int64_t>(request->max_bytes()));
    v1::ExportJobResponse chunk;
    chunk.set_data(page.substr(0, page.size() / 2));
    writer->Write(chunk);
    if (shared_.script.cut_export) return {grpc::StatusCode::UNAVAILABLE, "the script cuts here"};
    chunk.set_data(page.substr(page.size() / 2));
    chunk.set_frame_count(3);
    chunk.set_job_frame_count(request->max_bytes() == 0 ? 5 : 3);
    writer->Write(chunk);
    return grpc::Status::OK;
  }

 private:
  [[nodiscard]] bool knows(const std::string& name) const { return name == shared_.script.job.name(); }

  // Whether this watch is one to cut.
  bool note_watch(std::int64_t after_sequence) {
    const std::lock_guard lock(shared_.mutex);
    shared_.asked.after_sequences.push_back(after_sequence);
    return shared_.script.cut_streams-- > 0;
  }

  [[nodiscard]] const MeshFrame& find_stage(const v1::GetFrameRequest& request) const {
    const std::vector<MeshFrame>& stages = shared_.script.stages;
    if (request.which_case() == v1::GetFrameRequest::kIndex) {
      return request.index() < 0 ? stages.back() : stages.at(static_cast<std::size_t>(request.index()));
    }
    const auto distance = [&](const MeshFrame& stage) {
      return request.has_strain() ? std::abs(stage.frame.strain() - request.strain())
                                  : std::abs(stage.frame.time_s() - request.time_s());
    };
    return *std::min_element(stages.begin(), stages.end(),
                             [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  }

  Shared& shared_;
};

class FakeServer::Sweeps : public v1::Sweeps::Service {
 public:
  explicit Sweeps(Shared& shared) : shared_(shared) {}

  grpc::Status CreateSweep(grpc::ServerContext*, const v1::CreateSweepRequest* request, v1::Sweep* response) override {
    shared_.note(&AskedOfSweeps::creates, *request);
    *response = shared_.script.sweeps.sweep;
    if (shared_.loses_answer()) return kLost;
    return find(shared_.script.sweeps.sweep.name());
  }

  grpc::Status GetSweep(grpc::ServerContext*, const v1::GetSweepRequest* request, v1::Sweep* response) override {
    *response = shared_.script.sweeps.sweep;
    return find(request->name());
  }

  grpc::Status ListSweeps(grpc::ServerContext*, const v1::ListSweepsRequest* request,
                          v1::ListSweepsResponse* response) override {
    shared_.note(&AskedOfSweeps::lists, *request);
    *response->add_sweeps() = shared_.script.sweeps.sweep;
    if (request->page_token().empty()) response->set_next_page_token("second");
    return find(shared_.script.sweeps.sweep.name());
  }

  grpc::Status CancelSweep(grpc::ServerContext*, const v1::CancelSweepRequest* request, v1::Sweep* response) override {
    shared_.note(&AskedOfSweeps::cancelled, request->name());
    *response = shared_.script.sweeps.sweep;
    return find(request->name());
  }

  grpc::Status DeleteSweep(grpc::ServerContext*, const v1::DeleteSweepRequest* request,
                           v1::DeleteSweepResponse*) override {
    shared_.note(&AskedOfSweeps::deleted, request->name());
    return find(request->name());
  }

  grpc::Status RetryFailedJobs(grpc::ServerContext*, const v1::RetryFailedJobsRequest* request,
                               v1::Sweep* response) override {
    shared_.note(&AskedOfSweeps::retried, request->name());
    *response = shared_.script.sweeps.sweep;
    return find(request->name());
  }

  grpc::Status WatchSweep(grpc::ServerContext* context, const v1::WatchSweepRequest* request,
                          grpc::ServerWriter<v1::WatchSweepResponse>* writer) override {
    if (grpc::Status known = find(request->name()); !known.ok()) return known;
    bool cut = false;
    {
      const std::lock_guard lock(shared_.mutex);
      shared_.asked.sweeps.tokens.push_back(request->resume_token());
      cut = shared_.script.sweeps.cut_streams-- > 0;
    }
    v1::WatchSweepResponse snapshot;
    *snapshot.mutable_snapshot() = shared_.script.sweeps.sweep;
    writer->Write(snapshot);
    // A token is the number of responses before it.
    const std::size_t begin = request->resume_token().empty() ? 0 : std::stoul(request->resume_token());
    for (std::size_t i = begin; i < shared_.script.sweeps.responses.size(); ++i) {
      if (cut && i == begin + shared_.script.sweeps.responses_before_cut)
        return {grpc::StatusCode::UNAVAILABLE, "the script cuts here"};
      v1::WatchSweepResponse response = shared_.script.sweeps.responses[i];
      response.set_resume_token(std::to_string(i + 1));
      writer->Write(response);
    }
    while (shared_.script.sweeps.hold && !context->IsCancelled())
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return cut ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the script cuts here") : grpc::Status::OK;
  }

  grpc::Status GetSweepTable(grpc::ServerContext*, const v1::GetSweepTableRequest* request,
                             v1::SweepTable* response) override {
    // A page of two rows; a token is the number of rows before it, and the first page has the fields.
    constexpr int kPage = 2;
    int at = request->page_token().empty() ? 0 : std::stoi(request->page_token());
    const int end = std::min(shared_.script.sweeps.table.rows_size(), at + kPage);
    if (at == 0) *response->mutable_fields() = shared_.script.sweeps.table.fields();
    while (at < end) *response->add_rows() = shared_.script.sweeps.table.rows(at++);
    if (end < shared_.script.sweeps.table.rows_size()) response->set_next_page_token(std::to_string(end));
    return find(request->name());
  }

  grpc::Status GetConvergence(grpc::ServerContext*, const v1::GetConvergenceRequest* request,
                              v1::Convergence* response) override {
    *response = shared_.script.sweeps.convergence;
    response->set_wanted_error_relative(request->wanted_error_relative());
    return find(request->name());
  }

 private:
  [[nodiscard]] grpc::Status find(const std::string& name) const {
    if (shared_.script.sweeps.sweep.name().empty()) return {grpc::StatusCode::UNIMPLEMENTED, ""};
    if (name != shared_.script.sweeps.sweep.name()) return {grpc::StatusCode::NOT_FOUND, "there is no " + name};
    return grpc::Status::OK;
  }

  Shared& shared_;
};

class FakeServer::Admin : public v1::Admin::Service {
 public:
  explicit Admin(Shared& shared) : shared_(shared) {}

  grpc::Status GetQueue(grpc::ServerContext*, const v1::GetQueueRequest*, v1::Queue* response) override {
    if (!shared_.script.queue) return {grpc::StatusCode::UNIMPLEMENTED, ""};
    *response = *shared_.script.queue;
    return grpc::Status::OK;
  }

  grpc::Status WhoAmI(grpc::ServerContext*, const v1::WhoAmIRequest*, v1::WhoAmIResponse* response) override {
    if (!shared_.script.who) return {grpc::StatusCode::UNIMPLEMENTED, ""};
    *response = *shared_.script.who;
    return grpc::Status::OK;
  }

  grpc::Status CreateLink(grpc::ServerContext*, const v1::CreateLinkRequest* request,
                          v1::CreateLinkResponse* response) override {
    response->set_url("http://127.0.0.1:8080/sign-in?page=" + request->page());
    return grpc::Status::OK;
  }

 private:
  Shared& shared_;
};

FakeServer::FakeServer(Script script) : shared_(std::make_unique<Shared>()) {
  shared_->script = std::move(script);
  cases_ = std::make_unique<Cases>(*shared_);
  jobs_ = std::make_unique<Jobs>(*shared_);
  admin_ = std::make_unique<Admin>(*shared_);
  sweeps_ = std::make_unique<Sweeps>(*shared_);
  grpc::ServerBuilder builder;
  if (shared_->script.message_limit > 0) builder.SetMaxReceiveMessageSize(shared_->script.message_limit);
  builder.AddListeningPort(address(), grpc::InsecureServerCredentials());
  builder.RegisterService(cases_.get());
  builder.RegisterService(jobs_.get());
  builder.RegisterService(sweeps_.get());
  builder.RegisterService(admin_.get());
  server_ = builder.BuildAndStart();
  if (server_ == nullptr) throw std::runtime_error("the server of the test does not start");
}

FakeServer::~FakeServer() {
  server_->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
  server_->Wait();
}

Asked FakeServer::asked() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->asked;
}

ProgramResult FakeServer::run(std::vector<std::string> arguments, const std::string& input) const {
  arguments.insert(arguments.end(), {"--server", address()});
  return run_program(arguments, input);
}

}  // namespace cellcrush::client::testing
