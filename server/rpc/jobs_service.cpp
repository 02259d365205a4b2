#include <memory>
#include <optional>
#include <utility>

#include "compare/compare_test.h"
#include "error_table.h"
#include "rpc/export_source.h"
#include "rpc/job_query.h"
#include "rpc/jobs_source.h"
#include "rpc/request_fields.h"
#include "rpc/result_sources.h"
#include "rpc/services.h"
#include "store/job_state.h"
#include "store/resource_name.h"
#include "translate/case_checker.h"
#include "translate/case_words.h"
#include "translate/check_case.h"
#include "translate/materials.h"
#include "watch/job_source.h"

namespace cellcrush::rpc {
namespace {

constexpr int kSamplesAtOnce = 1000;

/// Reading tests of this size takes a tenth of a second.
constexpr std::size_t kLargeTests = 256 * 1024;

/// The calls of Jobs. Thread-safe. Streams hold no thread, even for slow readers; the pools run all other calls.
class JobCalls {
 public:
  explicit JobCalls(const ServiceParts& parts) : parts_(parts) {}

  v1::Job create_job(const Call& call, const v1::CreateJobRequest& request) {
    check_request(request.request_id(), request.labels());
    check_priority(request.priority(), "priority");
    parts_.admission.check_priority(request.priority(), "priority");
    parts_.admission.check_time_limit(request.time_limit_s(), "time_limit_s");
    check_length("executor", request.executor(), kLongestName);
    check_note("note", request.note());
    const std::string executor = parts_.queues.executor_for(request.executor(), "executor");
    check_size("case", request.case_().ByteSizeLong(), kLargestCase);
    std::optional<jobs::MeshPlaces::Place> mesh;
    const auto take_place = [&](std::int64_t elements) {
      if (!mesh) mesh.emplace(parts_.places, elements, [&call] { return call.is_cancelled(); });
    };
    const auto verdict = checkers_.check(request.case_(), take_place);
    if (!verdict.problems.empty()) throw RefusedCase({verdict.problems.begin(), verdict.problems.end()});
    v1::Job job;
    *job.mutable_case_() = translate::with_named_materials(request.case_());
    *job.mutable_labels() = request.labels();
    job.set_priority(request.priority());
    job.set_note(request.note());
    job.set_time_limit_s(request.time_limit_s());
    job.set_executor(executor);
    job.set_owner(call.caller().name);
    const auto with_notes = [&](v1::Job answer) {
      *answer.mutable_notes() = {verdict.notes.begin(), verdict.notes.end()};
      return answer;
    };
    if (request.validate_only()) return with_notes(std::move(job));
    const std::string hash = payload_hash(request, job.owner());
    const std::int64_t memory_bytes = parts_.admission.memory_of_job(verdict.most_memory_bytes, [&] {
      take_place(translate::CaseChecker().elements_to_build(request.case_()));
      return translate::predicted_memory(request.case_());
    });
    mesh.reset();
    const std::string owner = job.owner();
    std::optional<jobs::Admission::Place> place;
    const auto admit = [&] {
      place.reset();
      place.emplace(parts_.admission.admit(owner, 1, memory_bytes));
    };
    const auto created =
        parts_.journal.create_job(std::move(job), request.request_id(), hash, verdict.element_steps, admit);
    if (created.is_new) {
      log_change(parts_.audit, store::name_of(created.job), "created", owner, request.request_id());
      parts_.queues.enqueue(
          {{created.job, created.job, request.priority(), verdict.element_steps, 0, 0, owner, executor}});
      place.reset();
    }
    return with_notes(find_live(store::name_of(created.job)));
  }

  v1::Job get_job(const Call&, const v1::GetJobRequest& request) { return find_live(request.name()); }

  v1::ListJobsResponse list_jobs(const Call& call, const v1::ListJobsRequest& request) {
    check_length("filter", request.filter(), kLongestFilter);
    check_length("order_by", request.order_by(), kLongestOrder);
    const auto filter = parse_filter(request.filter());
    const bool newest_first = parse_newest_first(request.order_by());
    const std::string question = request.filter() + "\n" + (newest_first ? "newest" : "oldest");
    const auto page = read_page(request.page_size(), request.page_token(), question);
    auto stored = parts_.reader.list_jobs(filter, newest_first, page.after, page.size + 1, kPageBytes,
                                          [&call] { return call.is_cancelled(); });
    v1::ListJobsResponse out;
    std::int64_t last = 0;
    auto room = page.room();
    for (auto& job : stored) {
      if (!room.take(job.job.ByteSizeLong())) {
        out.set_next_page_token(page_token(last, question));
        break;
      }
      add_live(job);
      last = job.number;
      *out.add_jobs() = std::move(job.job);
    }
    return out;
  }

  v1::Job update_job(const Call& call, const v1::UpdateJobRequest& request) {
    const std::int64_t job = find_own(call, request.job().name());
    check_update(request.update_mask(), "job", request.job().note());
    if (parts_.journal.set_note(job, request.job().note(), request.previous_note())) {
      parts_.hub.recent().forget(job);
      log_change(parts_.audit, store::name_of(job), "annotated", call.caller().name);
    }
    return find_live(request.job().name());
  }

  v1::Job cancel_job(const Call& call, const v1::CancelJobRequest& request) {
    const std::int64_t job = find_own(call, request.name());
    parts_.queues.cancel(job);
    log_change(parts_.audit, store::name_of(job), "cancelled", call.caller().name);
    return find_live(request.name());
  }

  v1::Job suspend_job(const Call& call, const v1::SuspendJobRequest& request) {
    const std::int64_t job = find_own(call, request.name());
    make_logged_change(parts_.audit, store::name_of(job), "suspended", call.caller().name,
                       [&] { parts_.queues.suspend(job, [&call] { return call.is_cancelled(); }); });
    return find(request.name()).job;
  }

  v1::Job resume_job(const Call& call, const v1::ResumeJobRequest& request) {
    const std::int64_t job = find_own(call, request.name());
    parts_.queues.resume(job);
    log_change(parts_.audit, store::name_of(job), "resumed", call.caller().name);
    return find(request.name()).job;
  }

  v1::DeleteJobResponse delete_job(const Call& call, const v1::DeleteJobRequest& request) {
    const std::int64_t job = find_own(call, request.name());
    parts_.deletion.delete_job(job);
    log_change(parts_.audit, store::name_of(job), "deleted", call.caller().name);
    return {};
  }

  v1::GetHistoryResponse get_history(const Call&, const v1::GetHistoryRequest& request) {
    const std::int64_t job = find(request.name()).number;
    const std::string question = "history of " + store::name_of(job);
    const auto page = read_full_page(request.page_size(), request.page_token(), question);
    commit_samples();
    auto stored = parts_.reader.samples(job, page.after, page.room());
    v1::GetHistoryResponse out;
    for (auto& sample : stored.samples) *out.add_samples() = std::move(sample);
    if (stored.has_more) out.set_next_page_token(page_token(stored.last_sequence, question));
    return out;
  }

  v1::CompareTestResponse compare_test(const Call& call, const v1::CompareTestRequest& request) {
    auto stored = find(request.name());
    translate::add_words(stored.job);
    constexpr int kMostTests = 100;
    if (request.tests_size() > kMostTests)
      throw InvalidField("tests", "has " + std::to_string(request.tests_size()) + " tests.", "Give at most 100.");
    for (const auto& test : request.tests()) check_length("tests.name", test.name(), kLongestFilter);
    check_length("columns", request.columns(), kLongestFilter);
    check_length("force_part", request.force_part(), kLongestFilter);
    check_length("displacement_part", request.displacement_part(), kLongestName);
    compare::TestComparison comparison(request, stored.job, parts_.reader.mesh(stored.number));
    commit_samples();
    for (store::StoredSamples page{{}, 0, true}; page.has_more && !call.is_cancelled();) {
      page = parts_.reader.samples(stored.number, page.last_sequence, {kSamplesAtOnce, kPageBytes});
      for (const auto& sample : page.samples) comparison.add(sample);
    }
    return comparison.result();
  }

  std::unique_ptr<watch::JobSource> watch_job(const v1::WatchJobRequest& request) {
    const std::int64_t job = find(request.name()).number;
    check_epoch(parts_.reader.epoch(), request.epoch());
    return std::make_unique<watch::JobSource>(parts_.reader, parts_.hub, job, request.after_sequence(),
                                              watch::WatchCursor::Wanted{request.frames(), true, request.encoding()});
  }

  std::unique_ptr<JobsSource> watch_jobs(const v1::WatchJobsRequest& request) {
    return std::make_unique<JobsSource>(parts_, request);
  }

  std::unique_ptr<FrameSeriesSource> stream_frames(const v1::StreamFramesRequest& request) {
    return std::make_unique<FrameSeriesSource>(parts_, find(request.name()), request);
  }

  std::unique_ptr<FrameSource> get_frame(const v1::GetFrameRequest& request) {
    return std::make_unique<FrameSource>(parts_, find(request.name()), request);
  }

  std::unique_ptr<DownloadSource> download(const v1::DownloadResultRequest& request) {
    const auto stored = find(request.name());
    if (!stored.job.has_summary()) {
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         stored.job.name() + " is " + v1::Job::State_Name(stored.job.state()) +
                             " and has no result. A job has a result once it has SUCCEEDED, or was cancelled or failed "
                             "while running.");
    }
    return std::make_unique<DownloadSource>(parts_.folder.job_folder(stored.number).result(), request.offset());
  }

  std::unique_ptr<ExportSource> export_job(const v1::ExportJobRequest& request) {
    return std::make_unique<ExportSource>(ExportSource::Parts{parts_.folder, parts_.reader, parts_.places},
                                          find(request.name()), request);
  }

 private:
  /// Throws ServiceError (not_found) if there is none.
  store::StoredJob find(const std::string& name) { return find_job(parts_.reader, name); }

  /// With its progress and place.
  v1::Job find_live(const std::string& name) {
    auto stored = find(name);
    add_live(stored);
    return std::move(stored.job);
  }

  /// Number of a job that the caller may change. Also throws ServiceError (permission_denied).
  std::int64_t find_own(const Call& call, const std::string& name) {
    const auto stored = find(name);
    parts_.gate.require_own(call.caller(), stored.job.owner(), stored.job.name());
    return stored.number;
  }

  /// Adds what is not in the journal: progress and place.
  void add_live(store::StoredJob& stored) {
    const v1::Job::State state = stored.job.state();
    const auto channel = parts_.hub.find(stored.number);
    if (!channel || store::is_terminal(state)) return;
    const auto newest = channel->newest();
    stored.job.set_place(newest.place);
    const bool has_worker = state == v1::Job::RUNNING || state == v1::Job::CANCELLING;
    if (has_worker && newest.progress) *stored.job.mutable_progress() = *newest.progress;
  }

  /// Samples of an unwatched job may still be gathered in memory. If they cannot be made durable, only those before
  /// them are returned.
  void commit_samples() {
    try {
      parts_.journal.commit_samples();
    } catch (const ServiceError&) {
      // The journal retries on its own and logs the failure.
    }
  }

  const ServiceParts& parts_;
  translate::SharedCheckers checkers_;
};

}  // namespace

void add_jobs_methods(MethodTable& table, const ServiceParts& parts) {
  using access::Scope;
  const auto calls = std::make_shared<JobCalls>(parts);
  table.unary("/cellcrush.v1.Jobs/CreateJob", Scope::submit, &parts.checks, calls, &JobCalls::create_job,
              [](const v1::CreateJobRequest& request) { return is_large_case(request.case_()); });
  table.unary("/cellcrush.v1.Jobs/GetJob", Scope::read, &parts.calls, calls, &JobCalls::get_job);
  table.unary("/cellcrush.v1.Jobs/ListJobs", Scope::read, &parts.calls, calls, &JobCalls::list_jobs);
  table.unary("/cellcrush.v1.Jobs/UpdateJob", Scope::submit, &parts.calls, calls, &JobCalls::update_job);
  table.unary("/cellcrush.v1.Jobs/CancelJob", Scope::submit, &parts.calls, calls, &JobCalls::cancel_job);
  table.unary("/cellcrush.v1.Jobs/SuspendJob", Scope::submit, &parts.calls, calls, &JobCalls::suspend_job);
  table.unary("/cellcrush.v1.Jobs/ResumeJob", Scope::submit, &parts.calls, calls, &JobCalls::resume_job);
  table.unary("/cellcrush.v1.Jobs/DeleteJob", Scope::submit, &parts.calls, calls, &JobCalls::delete_job);
  table.unary("/cellcrush.v1.Jobs/GetHistory", Scope::read, &parts.calls, calls, &JobCalls::get_history);
  table.unary("/cellcrush.v1.Jobs/CompareTest", Scope::read, &parts.checks, calls, &JobCalls::compare_test,
              [](const v1::CompareTestRequest& request) { return request.ByteSizeLong() > kLargeTests; });
  table.stream("/cellcrush.v1.Jobs/WatchJob", Scope::read, parts.streams, calls, &JobCalls::watch_job);
  table.stream("/cellcrush.v1.Jobs/WatchJobs", Scope::read, parts.streams, calls, &JobCalls::watch_jobs);
  table.stream("/cellcrush.v1.Jobs/StreamFrames", Scope::read, parts.streams, calls, &JobCalls::stream_frames);
  table.stream("/cellcrush.v1.Jobs/GetFrame", Scope::read, parts.streams, calls, &JobCalls::get_frame);
  table.stream("/cellcrush.v1.Jobs/DownloadResult", Scope::read, parts.streams, calls, &JobCalls::download);
  table.stream("/cellcrush.v1.Jobs/ExportJob", Scope::read, parts.exports, calls, &JobCalls::export_job);
}

}  // namespace cellcrush::rpc
