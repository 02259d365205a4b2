#include <absl/cleanup/cleanup.h>
#include <malloc.h>

#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "columns/swept_fields.h"
#include "error_table.h"
#include "jobs/convergence.h"
#include "jobs/seed_means.h"
#include "jobs/sweep_plan.h"
#include "jobs/sweep_points.h"
#include "rpc/request_fields.h"
#include "rpc/services.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"
#include "translate/case_checker.h"
#include "translate/check_case.h"
#include "watch/sweep_source.h"

namespace cellcrush::rpc {
namespace {

constexpr std::int64_t kPointBytes = 500;  // of a point of a sweep, until its job is queued

// The caller's fields only; the daemon sets the rest.
v1::CreateSweepRequest without_output(v1::CreateSweepRequest request) {
  auto& sweep = *request.mutable_sweep();
  sweep.clear_name();
  sweep.clear_create_time();
  sweep.clear_jobs();
  sweep.clear_state_counts();
  sweep.clear_owner();
  sweep.clear_notes();
  sweep.clear_predicted_seconds();
  sweep.clear_words();
  return request;
}

void check_numbers(const v1::Sweep& sweep) {
  check_priority(sweep.priority(), "sweep.priority");
  if (sweep.max_parallel() < 0) throw InvalidField("sweep.max_parallel", "is negative.", "Use 0 for no limit.");
  if (sweep.max_failures() < 0) throw InvalidField("sweep.max_failures", "is negative.", "Use 0 for no limit.");
}

std::vector<store::QueuedJob> queued_jobs(const store::Journal::CreatedSweep& created, const jobs::SweepPlan& plan,
                                          const v1::Sweep& sweep, const std::string& executor) {
  std::vector<store::QueuedJob> out;
  for (std::size_t i = 0; i < created.jobs.size(); ++i) {
    out.push_back({created.jobs[i], created.jobs.front(), sweep.priority(), plan.jobs[i].element_steps, created.sweep,
                   sweep.max_parallel(), sweep.owner(), executor});
  }
  return out;
}

double predicted_seconds_of(const jobs::SweepPlan& plan, double step_cost) {
  double element_steps = 0.0;
  for (const auto& job : plan.jobs) element_steps += static_cast<double>(job.element_steps);
  return step_cost * element_steps;
}

/// The calls of Sweeps. Thread-safe. Watches hold no thread; the pools run all other calls.
class SweepCalls {
 public:
  explicit SweepCalls(const ServiceParts& parts) : parts_(parts) {}

  v1::Sweep create_sweep(const Call& call, const v1::CreateSweepRequest& given) {
    auto request = without_output(given);
    check_size("sweep", request.sweep().ByteSizeLong(), kLargestCase);
    check_request(request.request_id(), request.sweep().labels(), "sweep.");
    check_numbers(request.sweep());
    parts_.admission.check_priority(request.sweep().priority(), "sweep.priority");
    parts_.admission.check_time_limit(request.sweep().time_limit_s(), "sweep.time_limit_s");
    check_length("sweep.executor", request.sweep().executor(), kLongestName);
    check_note("sweep.note", request.sweep().note());
    const std::string executor = parts_.queues.executor_for(request.sweep().executor(), "sweep.executor");
    const std::string owner = call.caller().name;
    const std::string hash = payload_hash(request, owner);
    request.mutable_sweep()->set_owner(owner);
    const auto given_up = [&call] { return call.is_cancelled(); };
    const absl::Cleanup return_heap = [] { malloc_trim(0); };
    const auto plan = jobs::plan_sweep(request.sweep(), {parts_.places, parts_.check_threads, given_up, executor});
    if (!plan.problems.empty()) throw RefusedCase(plan.problems, "sweep");
    const auto with_notes = [&](v1::Sweep answer) {
      *answer.mutable_notes() = plan.notes;
      answer.set_predicted_seconds(predicted_seconds_of(plan, parts_.step_cost));
      return answer;
    };
    if (request.validate_only()) return with_notes(request.sweep());
    const std::int64_t memory_bytes = parts_.admission.memory_of_job(plan.most_memory_bytes, [&] {
      const v1::Case largest = plan.jobs[plan.largest].job().case_();
      const jobs::MeshPlaces::Place mesh(parts_.places, translate::CaseChecker().elements_to_build(largest), given_up);
      return translate::predicted_memory(largest);
    });
    std::optional<jobs::Admission::Place> place;
    const auto admit = [&] {
      place.reset();
      place.emplace(parts_.admission.admit(owner, plan.jobs.size(), memory_bytes));
    };
    const auto created = parts_.journal.create_sweep(request.sweep(), plan.jobs, request.request_id(), hash, admit);
    const std::string name = store::sweep_name_of(created.sweep);
    if (created.is_new) {
      log_change(parts_.audit, name, "created with " + std::to_string(plan.jobs.size()) + " jobs", owner,
                 request.request_id());
      parts_.queues.enqueue(queued_jobs(created, plan, request.sweep(), executor));
      place.reset();
    }
    return with_notes(find(name).sweep);
  }

  v1::Sweep get_sweep(const Call&, const v1::GetSweepRequest& request) { return find(request.name()).sweep; }

  v1::ListSweepsResponse list_sweeps(const Call& call, const v1::ListSweepsRequest& request) {
    const auto page = read_page(request.page_size(), request.page_token(), "sweeps");
    const std::int64_t before = page.after == 0 ? std::numeric_limits<std::int64_t>::max() : page.after;
    v1::ListSweepsResponse out;
    auto room = page.room();
    std::int64_t last = 0;
    const auto numbers = parts_.sweeps.list_sweeps(before, page.size + 1);
    bool has_more = static_cast<int>(numbers.size()) > page.size;
    for (const std::int64_t number : numbers) {
      call.require_wanted();
      auto sweep = parts_.sweeps.find_sweep(number);
      if (sweep && !room.take(sweep->ByteSizeLong())) {
        has_more = true;
        break;
      }
      last = number;
      // Otherwise it was deleted meanwhile.
      if (sweep) *out.add_sweeps() = *std::move(sweep);
    }
    if (has_more) out.set_next_page_token(page_token(last, "sweeps"));
    return out;
  }

  v1::Sweep update_sweep(const Call& call, const v1::UpdateSweepRequest& request) {
    const std::int64_t sweep = find_own(call, request.sweep().name());
    check_update(request.update_mask(), "sweep", request.sweep().note());
    if (parts_.journal.set_sweep_note(sweep, request.sweep().note(), request.previous_note()))
      log_change(parts_.audit, store::sweep_name_of(sweep), "annotated", call.caller().name);
    return find(request.sweep().name()).sweep;
  }

  v1::Sweep cancel_sweep(const Call& call, const v1::CancelSweepRequest& request) {
    const std::int64_t sweep = find_own(call, request.name());
    const auto jobs = parts_.sweeps.jobs_of(sweep);
    make_logged_change(parts_.audit, store::sweep_name_of(sweep), "cancelled", call.caller().name,
                       [&] { parts_.queues.cancel_all(jobs); });
    return find(request.name()).sweep;
  }

  v1::DeleteSweepResponse delete_sweep(const Call& call, const v1::DeleteSweepRequest& request) {
    const std::int64_t sweep = find_own(call, request.name());
    make_logged_change(parts_.audit, store::sweep_name_of(sweep), "deleted", call.caller().name,
                       [&] { parts_.deletion.delete_sweep(sweep, [&call] { return call.is_cancelled(); }); });
    return {};
  }

  v1::Sweep retry_failed_jobs(const Call& call, const v1::RetryFailedJobsRequest& request) {
    const std::int64_t sweep = find_own(call, request.name());
    // The resources for these cases were admitted with the sweep. The new jobs belong to the sweep's owner.
    const std::string owner = find(request.name()).sweep.owner();
    const auto jobs = parts_.sweeps.jobs_of(sweep);
    if (!jobs.empty()) parts_.queues.require(parts_.reader.executor_of(jobs.front()).value_or(store::kLocalExecutor));
    std::optional<jobs::Admission::Place> place;
    const auto admit = [&](std::size_t count) {
      place.reset();
      place.emplace(parts_.admission.admit(owner, count, 0));
    };
    const auto retried = parts_.journal.retry_failed(sweep, admit);
    log_change(parts_.audit, store::sweep_name_of(sweep), "retried with " + std::to_string(retried.size()) + " jobs",
               call.caller().name);
    parts_.queues.enqueue(retried);
    place.reset();
    return find(request.name()).sweep;
  }

  v1::SweepTable get_sweep_table(const Call&, const v1::GetSweepTableRequest& request) {
    const auto found = find(request.name(), store::SweepReader::Jobs::left_out);
    if (request.mean_over_seeds()) return seed_means(found, request);
    const std::string question = "table of " + found.sweep.name();
    const auto page = read_full_page(request.page_size(), request.page_token(), question);
    v1::SweepTable out;
    if (page.after == 0) {
      for (auto& field : swept_fields(found.sweep)) out.add_fields(std::move(field));
    }
    auto stored = parts_.sweeps.rows(found.number, page.after, page.room());
    for (auto& row : stored.rows) *out.add_rows() = std::move(row);
    if (stored.has_more) out.set_next_page_token(page_token(stored.last_point, question));
    return out;
  }

  v1::Convergence get_convergence(const Call&, const v1::GetConvergenceRequest& request) {
    const double wanted = request.wanted_error_relative();
    if (!(wanted >= 0.0 && wanted <= 1.0)) {
      throw InvalidField("wanted_error_relative", "is " + std::to_string(wanted) + ", not between 0 and 1.",
                         "Use a fraction such as 0.05, or 0 for the default.");
    }
    const auto found = find(request.name());
    return jobs::convergence_of(found.sweep, parts_.sweeps.rows(found.number).rows,
                                wanted > 0.0 ? wanted : jobs::kWantedError);
  }

  std::unique_ptr<watch::SweepSource> watch_sweep(const v1::WatchSweepRequest& request) {
    check_length("resume_token", request.resume_token(), kLongestResumeToken);
    return std::make_unique<watch::SweepSource>(parts_.reader, parts_.sweeps, parts_.hub, find(request.name()).number,
                                                request.resume_token());
  }

 private:
  struct Found {
    std::int64_t number = 0;
    v1::Sweep sweep;
  };
  /// A page of the table's means. Every page reads all rows, some megabytes at a time.
  v1::SweepTable seed_means(const Found& found, const v1::GetSweepTableRequest& request) {
    const std::string question = "means of " + found.sweep.name();
    const auto page = read_full_page(request.page_size(), request.page_token(), question);
    v1::SweepTable out;
    if (page.after == 0) {
      for (auto& field : swept_fields(found.sweep)) out.add_fields(std::move(field));
    }
    jobs::SeedMeans means(found.sweep);
    if (!means.varies_seed()) return out;
    store::StoredRows stored;
    do {
      const auto after = stored.last_point;
      stored = parts_.sweeps.rows(found.number, after, {std::numeric_limits<int>::max(), kPageBytes});
      for (const auto& row : stored.rows) means.add(row);
    } while (stored.has_more);
    auto room = page.room();
    for (auto point = static_cast<std::size_t>(page.after); point < means.size(); ++point) {
      auto of_point = means.means(point);
      if (!room.take(of_point.ByteSizeLong())) {
        out.set_next_page_token(page_token(static_cast<std::int64_t>(point), question));
        break;
      }
      *out.add_means() = std::move(of_point);
    }
    return out;
  }

  /// Throws ServiceError: not_found if there is none, data_loss for a damaged one.
  Found find(const std::string& name, store::SweepReader::Jobs jobs = store::SweepReader::Jobs::listed) {
    auto found = find_any(name, jobs);
    if (!found.sweep.has_create_time()) throw store::unreadable_sweep(found.number);
    return found;
  }

  Found find_any(const std::string& name, store::SweepReader::Jobs jobs) {
    check_length("name", name, kLongestName);
    const auto number = store::sweep_number_of(name);
    auto sweep = number ? parts_.sweeps.find_sweep(*number, jobs) : std::nullopt;
    if (!sweep) {
      throw ServiceError(ServiceError::Kind::not_found,
                         "There is no sweep \"" + name + "\". Sweep names look like sweeps/12; ListSweeps lists them.");
    }
    return {*number, *std::move(sweep)};
  }

  /// Number of a sweep that the caller may change. Also throws ServiceError (permission_denied).
  std::int64_t find_own(const Call& call, const std::string& name) {
    const auto found = find_any(name, store::SweepReader::Jobs::left_out);
    parts_.gate.require_own(call.caller(), found.sweep.owner(), found.sweep.name());
    return found.number;
  }

  const ServiceParts& parts_;
};

}  // namespace

void add_sweeps_methods(MethodTable& table, const ServiceParts& parts) {
  using access::Scope;
  const auto calls = std::make_shared<SweepCalls>(parts);
  table.unary(
      "/cellcrush.v1.Sweeps/CreateSweep", Scope::submit, &parts.checks, calls, &SweepCalls::create_sweep,
      [](const v1::CreateSweepRequest&) { return true; },
      [](const v1::CreateSweepRequest& request) { return kPointBytes * jobs::most_points(request.sweep()); });
  table.unary("/cellcrush.v1.Sweeps/GetSweep", Scope::read, &parts.calls, calls, &SweepCalls::get_sweep);
  table.unary("/cellcrush.v1.Sweeps/ListSweeps", Scope::read, &parts.calls, calls, &SweepCalls::list_sweeps);
  table.unary("/cellcrush.v1.Sweeps/UpdateSweep", Scope::submit, &parts.calls, calls, &SweepCalls::update_sweep);
  table.unary("/cellcrush.v1.Sweeps/CancelSweep", Scope::submit, &parts.calls, calls, &SweepCalls::cancel_sweep);
  table.unary("/cellcrush.v1.Sweeps/DeleteSweep", Scope::submit, &parts.calls, calls, &SweepCalls::delete_sweep);
  table.unary("/cellcrush.v1.Sweeps/RetryFailedJobs", Scope::submit, &parts.calls, calls,
              &SweepCalls::retry_failed_jobs);
  table.unary("/cellcrush.v1.Sweeps/GetSweepTable", Scope::read, &parts.calls, calls, &SweepCalls::get_sweep_table);
  table.unary("/cellcrush.v1.Sweeps/GetConvergence", Scope::read, &parts.calls, calls, &SweepCalls::get_convergence);
  table.stream("/cellcrush.v1.Sweeps/WatchSweep", Scope::read, parts.streams, calls, &SweepCalls::watch_sweep);
}

}  // namespace cellcrush::rpc
