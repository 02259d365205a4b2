#include "fake_server.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

#include "synthetic_crush.h"

namespace cellcrush::client::testing {

namespace {

std::filesystem::path make_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "cellcrush-client-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

grpc::Status not_found(const std::string& name) { return {grpc::StatusCode::NOT_FOUND, "there is no " + name}; }

}  // namespace

struct FakeServer::Shared {
  Script script;
  mutable std::mutex mutex;  ///< guards `asked` and the counters of the script
  Asked asked;
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
    const std::lock_guard lock(shared_.mutex);
    shared_.asked.creates.push_back(*request);
    *response = shared_.script.job;
    return shared_.script.create_status;
  }

  grpc::Status GetJob(grpc::ServerContext*, const v1::GetJobRequest* request, v1::Job* response) override {
    if (!knows(request->name())) return not_found(request->name());
    *response = shared_.script.job;
    return grpc::Status::OK;
  }

  grpc::Status ListJobs(grpc::ServerContext*, const v1::ListJobsRequest* request,
                        v1::ListJobsResponse* response) override {
    *response->add_jobs() = shared_.script.job;
    if (request->page_token().empty()) response->set_next_page_token("second");
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
    for (const v1::Sample& sample : shared_.script.samples) *response->add_samples() = sample;
    return grpc::Status::OK;
  }

  grpc::Status GetFrame(grpc::ServerContext*, const v1::GetFrameRequest* request,
                        grpc::ServerWriter<v1::GetFrameResponse>* writer) override {
    if (!knows(request->name()) || shared_.script.stages.empty()) return not_found(request->name());
    const MeshFrame& stage = find_stage(*request);
    v1::GetFrameResponse first;
    *first.mutable_mesh() = stage.mesh;
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
      chunk.set_total_size(static_cast<std::int64_t>(file.size()));
      writer->Write(chunk);
    }
    return end == file.size() ? grpc::Status::OK : grpc::Status(grpc::StatusCode::UNAVAILABLE, "the script cuts here");
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
    if (request.which_case() == v1::GetFrameRequest::kIndex) return stages.back();
    const auto distance = [&](const MeshFrame& stage) {
      return request.has_strain() ? std::abs(stage.frame.strain() - request.strain())
                                  : std::abs(stage.frame.time_s() - request.time_s());
    };
    return *std::min_element(stages.begin(), stages.end(),
                             [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  }

  Shared& shared_;
};

FakeServer::FakeServer(Script script) : folder_(make_folder()), shared_(std::make_unique<Shared>()) {
  shared_->script = std::move(script);
  cases_ = std::make_unique<Cases>(*shared_);
  jobs_ = std::make_unique<Jobs>(*shared_);
  grpc::ServerBuilder builder;
  builder.AddListeningPort(address(), grpc::InsecureServerCredentials());
  builder.RegisterService(cases_.get());
  builder.RegisterService(jobs_.get());
  builder.RegisterService(&sweeps_);
  builder.RegisterService(&admin_);
  server_ = builder.BuildAndStart();
  if (server_ == nullptr) throw std::runtime_error("the server of the test does not start");
}

FakeServer::~FakeServer() {
  server_->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
  server_->Wait();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Asked FakeServer::asked() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->asked;
}

v1::Job make_job(v1::JobState state) {
  v1::Job job;
  job.set_name("jobs/test");
  job.set_state(state);
  job.mutable_case_()->set_title("Type I of the tests");
  job.mutable_case_()->mutable_loading()->set_speed_m_per_s(100.0);
  job.mutable_case_()->mutable_loading()->set_end_strain(0.8);
  job.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_columns(74);
  job.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_rows(21);
  if (state == v1::FAILED) {
    job.set_cause(v1::SOLVER_DIVERGED);
    job.set_cause_message("particle 12 left the scene at step 340");
    job.set_remedy("lower numerics.time_step_s");
  }
  if (state == v1::SUCCEEDED) {
    v1::Summary& summary = *job.mutable_summary();
    summary.set_plateau_window_low(0.2);
    summary.set_plateau_window_high(0.4);
    summary.set_plateau_stress_impact_mpa(3.412);
    summary.set_plateau_stress_support_mpa(0.4471);
    summary.set_densification_strain(0.76);
    summary.set_energy_error_relative(0.0123);
    summary.set_deepest_penetration(0.121);
    summary.set_step_count(20504);
    summary.set_solver_seconds(45.3);
    summary.mutable_theory()->set_shock_mpa(3.37);
    summary.mutable_theory()->set_gibson_ashby_mpa(0.301);
    summary.mutable_theory()->set_densification_strain(0.86);
    job.mutable_start_time()->set_seconds(1000);
    job.mutable_end_time()->set_seconds(1047);
  }
  return job;
}

std::vector<v1::JobEvent> make_events(int samples, v1::JobState state) {
  std::vector<v1::JobEvent> events(1);
  events.back().set_sequence(1);
  *events.back().mutable_state() = make_job(v1::RUNNING);
  const auto history = synthetic_samples(samples, 0.8);
  for (int i = 0; i < samples; ++i) {
    v1::JobEvent& sample = events.emplace_back();
    sample.set_sequence(i + 2);
    *sample.mutable_sample() = history[static_cast<std::size_t>(i)];
    v1::JobEvent& progress = events.emplace_back();
    progress.set_sequence(i + 2);
    progress.mutable_progress()->set_fraction(static_cast<double>(i + 1) / samples);
    progress.mutable_progress()->set_strain(sample.sample().strain());
    progress.mutable_progress()->set_stress_impact_mpa(sample.sample().stress_impact_mpa());
    progress.mutable_progress()->set_stress_support_mpa(sample.sample().stress_support_mpa());
    progress.mutable_progress()->set_steps_per_second(431.0);
    progress.mutable_progress()->set_seconds_left(0.05 * (samples - i - 1));
    if (sample.sample().strain() > 0.2) progress.mutable_progress()->set_plateau_so_far_mpa(3.39);
  }
  v1::JobEvent& end = events.emplace_back();
  end.set_sequence(samples + 2);
  *end.mutable_state() = make_job(state);
  return events;
}

}  // namespace cellcrush::client::testing
