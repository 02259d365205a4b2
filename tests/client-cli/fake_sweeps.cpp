#include "fake_sweeps.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "scripted_job.h"

namespace cellcrush::client::testing {

FakeSweeps::FakeSweeps(SweepScript script) : script_(std::move(script)), cuts_left_(script_.cut_streams) {}

AskedOfSweeps FakeSweeps::asked() const {
  const std::lock_guard lock(mutex_);
  return asked_;
}

grpc::Status FakeSweeps::find(const std::string& name) const {
  if (script_.sweep.name().empty()) return {grpc::StatusCode::UNIMPLEMENTED, ""};
  if (name != script_.sweep.name()) return {grpc::StatusCode::NOT_FOUND, "there is no " + name};
  return grpc::Status::OK;
}

grpc::Status FakeSweeps::CreateSweep(grpc::ServerContext*, const v1::CreateSweepRequest* request, v1::Sweep* response) {
  const std::lock_guard lock(mutex_);
  asked_.creates.push_back(*request);
  *response = script_.sweep;
  return find(script_.sweep.name());
}

grpc::Status FakeSweeps::GetSweep(grpc::ServerContext*, const v1::GetSweepRequest* request, v1::Sweep* response) {
  *response = script_.sweep;
  return find(request->name());
}

grpc::Status FakeSweeps::ListSweeps(grpc::ServerContext*, const v1::ListSweepsRequest* request,
                                    v1::ListSweepsResponse* response) {
  const std::lock_guard lock(mutex_);
  asked_.lists.push_back(*request);
  *response->add_sweeps() = script_.sweep;
  if (request->page_token().empty()) response->set_next_page_token("second");
  return find(script_.sweep.name());
}

grpc::Status FakeSweeps::CancelSweep(grpc::ServerContext*, const v1::CancelSweepRequest* request, v1::Sweep* response) {
  const std::lock_guard lock(mutex_);
  asked_.cancelled.push_back(request->name());
  *response = script_.sweep;
  return find(request->name());
}

grpc::Status FakeSweeps::DeleteSweep(grpc::ServerContext*, const v1::DeleteSweepRequest* request,
                                     v1::DeleteSweepResponse*) {
  const std::lock_guard lock(mutex_);
  asked_.deleted.push_back(request->name());
  return find(request->name());
}

grpc::Status FakeSweeps::RetryFailedJobs(grpc::ServerContext*, const v1::RetryFailedJobsRequest* request,
                                         v1::Sweep* response) {
  const std::lock_guard lock(mutex_);
  asked_.retried.push_back(request->name());
  *response = script_.sweep;
  return find(request->name());
}

grpc::Status FakeSweeps::WatchSweep(grpc::ServerContext* context, const v1::WatchSweepRequest* request,
                                    grpc::ServerWriter<v1::WatchSweepResponse>* writer) {
  if (grpc::Status known = find(request->name()); !known.ok()) return known;
  bool cut = false;
  {
    const std::lock_guard lock(mutex_);
    asked_.tokens.push_back(request->resume_token());
    cut = cuts_left_-- > 0;
  }
  v1::WatchSweepResponse snapshot;
  *snapshot.mutable_snapshot() = script_.sweep;
  writer->Write(snapshot);
  // A token is the number of responses before it.
  const std::size_t begin = request->resume_token().empty() ? 0 : std::stoul(request->resume_token());
  for (std::size_t i = begin; i < script_.responses.size(); ++i) {
    if (cut && i == begin + script_.responses_before_cut)
      return {grpc::StatusCode::UNAVAILABLE, "the script cuts here"};
    v1::WatchSweepResponse response = script_.responses[i];
    response.set_resume_token(std::to_string(i + 1));
    writer->Write(response);
  }
  while (script_.hold && !context->IsCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return cut ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the script cuts here") : grpc::Status::OK;
}

grpc::Status FakeSweeps::GetSweepTable(grpc::ServerContext*, const v1::GetSweepTableRequest* request,
                                       v1::SweepTable* response) {
  // A page of two rows; a token is the number of rows before it, and the first page has the fields.
  constexpr int kPage = 2;
  int at = request->page_token().empty() ? 0 : std::stoi(request->page_token());
  const int end = std::min(script_.table.rows_size(), at + kPage);
  if (at == 0) *response->mutable_fields() = script_.table.fields();
  while (at < end) *response->add_rows() = script_.table.rows(at++);
  if (end < script_.table.rows_size()) response->set_next_page_token(std::to_string(end));
  return find(request->name());
}

grpc::Status FakeSweeps::GetConvergence(grpc::ServerContext*, const v1::GetConvergenceRequest* request,
                                        v1::Convergence* response) {
  *response = script_.convergence;
  response->set_wanted_error_relative(request->wanted_error_relative());
  return find(request->name());
}

SweepScript make_sweep_script(const std::vector<v1::Job::State>& ends) {
  SweepScript script;
  script.sweep.set_name("sweeps/test");
  *script.sweep.mutable_case_() = make_job(v1::Job::RUNNING).case_();
  script.sweep.add_axes()->set_field("loading.speed_m_per_s");
  script.table.add_fields("loading.speed_m_per_s");
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::string name = "jobs/test-" + std::to_string(i + 1);
    const double speed = 50.0 * static_cast<double>(i + 1);
    const auto in_state = [&](v1::Job::State state) {
      v1::Job job = make_job(state);
      job.set_name(name);
      job.mutable_case_()->mutable_loading()->set_speed_m_per_s(speed);
      if (job.has_summary()) job.mutable_summary()->set_plateau_stress_impact_mpa(0.3 + 3e-4 * speed * speed);
      return job;
    };
    script.sweep.add_jobs(name);
    script.sweep.mutable_axes(0)->mutable_list()->add_values(speed);
    ++(*script.sweep.mutable_state_counts())[v1::Job::State_Name(ends[i])];
    const auto add = [&] {
      script.responses.emplace_back().set_job(name);
      return script.responses.back().mutable_event();
    };
    *add()->mutable_snapshot()->mutable_job() = in_state(v1::Job::PENDING);
    for (const v1::JobEvent& event : make_events(4, ends[i])) {
      v1::JobEvent& sent = *add();
      sent = event;
      if (event.has_state()) *sent.mutable_state() = in_state(event.state().state());
    }
    auto& row = *script.table.add_rows();
    row.set_job(name);
    row.add_values(speed);
    *row.mutable_result() = in_state(ends[i]);
  }
  return script;
}

}  // namespace cellcrush::client::testing
