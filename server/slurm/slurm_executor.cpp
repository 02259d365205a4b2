#include "slurm/slurm_executor.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

#include "columns/sample_parts.h"
#include "error.h"
#include "jobs/queue_forecast.h"
#include "slurm/attempt_follower.h"
#include "slurm/mirror.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"
#include "store/lattice_file.h"
#include "store/report_log.h"
#include "store/resource_name.h"
#include "store/result_writer.h"
#include "translate/case_to_spec.h"
#include "translate/worker_memory.h"

namespace cellcrush::slurm {
namespace {

// Removes half a report at the end, which a killed daemon or worker may have left.
void cut_incomplete_report(const store::JobFolder& folder) { store::ReportLog log(folder.reports()); }

// For what the forecast misses: reports take more room than the compressed result.
constexpr std::int64_t kForecastFactor = 4;
constexpr std::int64_t kForecastBeside = std::int64_t{64} << 20;
constexpr std::int64_t kPartOfSample = 1024;  // bytes of a watched node, a rigid wall or a grip in a sample

// Limit of each file that a task hands over. A checkpoint is no larger than the run's memory.
std::uint64_t most_bytes_of(const v1::Case& submitted, const translate::CaseChecker::Verdict& verdict) {
  const auto spec = translate::to_spec(submitted).spec;
  const v1::Sample named = sample_parts_of(submitted);
  const std::int64_t parts = named.watched_size() + named.rigid_walls_size() + named.grips_size();
  const std::int64_t samples = spec.output.sample_count;
  const std::int64_t files = store::predicted_result_bytes(2 * verdict.element_count, verdict.element_count,
                                                           verdict.element_count, samples, spec.output.frame_count) +
                             samples * parts * kPartOfSample;
  return static_cast<std::uint64_t>(kForecastFactor * files + verdict.most_memory_bytes + kForecastBeside);
}

ClusterOptions with_canonical_folder(ClusterOptions options) {
  options.named_folder = options.folder;
  options.folder = store::canonical_of(options.folder);
  return options;
}

}  // namespace

SlurmExecutor::SlurmExecutor(ClusterOptions options, double step_cost, std::unique_ptr<jobs::LocalProcess> local)
    : options_(with_canonical_folder(std::move(options))),
      step_cost_(step_cost),
      local_(std::move(local)),
      commands_(options_.commands, options_.times.command),
      view_(commands_, options_.times.squeue),
      batcher_(options_, commands_) {}

// The threads of its parts need not wait for a controller that does not answer. A submission without an answer is
// looked for by the next daemon.
SlurmExecutor::~SlurmExecutor() { commands_.stop(); }

bool SlurmExecutor::has_worker(const store::JobFolder& folder) {
  const auto attempt = read_attempt(folder);
  return (attempt && !attempt->batch().empty()) || local_->has_worker(folder);
}

std::optional<jobs::WorkerExit> SlurmExecutor::read_final_report(const store::JobFolder& folder,
                                                                 const jobs::WorkerEvents& events) {
  return local_->read_final_report(folder, events);
}

void SlurmExecutor::end_worker(const store::JobFolder& folder) {
  local_->end_worker(folder);
  if (const auto attempt = read_attempt(folder)) end_attempt(folder, *attempt);
}

void SlurmExecutor::end_attempt(const store::JobFolder& folder, const Attempt& attempt) {
  const AttemptFolder shared = folder_of(attempt);
  require_marker(options_.folder);
  Claim claim;
  claim.set_withdrawn(true);
  const bool has_begun = shared.exists() && !shared.claim(claim);
  if (has_begun) shared.request(Request::ABANDON);
  if (attempt.slurm_job() != 0 && attempt.shares() <= 1)
    static_cast<void>(commands_.scancel(attempt.slurm_job(), task_index(attempt)));
  static_cast<void>(store::remove_own(folder.attempt()));
  shared.remove();
  tidy_up_after(attempt, has_begun);
}

void SlurmExecutor::tidy_up_after(const Attempt& attempt, bool has_begun) {
  if (attempt.batch().empty()) return;
  const auto folder = Batcher::batch_folder(options_, attempt.batch());
  const auto is_over = [this](const Batch::Task& task) {
    return std::ranges::none_of(task.attempts(),
                                [this](const std::string& id) { return AttemptFolder(options_.folder, id).exists(); });
  };
  try {
    const auto batch = read_message<Batch>(folder / "tasks");
    if (!batch) return;
    const bool is_shared = attempt.shares() > 1 && attempt.slurm_job() != 0 && attempt.task() < batch->tasks_size();
    if (is_shared && !has_begun && is_over(batch->tasks(attempt.task())))
      static_cast<void>(commands_.scancel(attempt.slurm_job(), task_index(attempt)));
    // From the end: later tasks tend to end later.
    for (int task = batch->tasks_size(); --task >= 0;) {
      if (!is_over(batch->tasks(task))) return;
    }
    if (const int error = store::remove_own(folder); error != 0) store::throw_file_error(folder, "removed", error);
    store::remove_unused_lattices(AttemptFolder(options_.folder, attempt.id()).files().lattices());
  } catch (const std::exception& error) {
    spdlog::warn("{} cannot be removed: {}", folder.string(), error.what());
  }
}

Need SlurmExecutor::predict(const worker::Order& order, Attempt& attempt) {
  const MutexLock lock(checker_mutex_);
  const auto verdict = checker_.check(order.case_());
  attempt.set_most_bytes(most_bytes_of(order.case_(), verdict));
  store::QueuedJob job;
  job.element_steps = verdict.element_steps;
  const auto limit = [&](double factor) {
    return translate::memory_limit(verdict.most_memory_bytes, order.threads(), factor, order.most_memory_bytes());
  };
  const auto first = limit(1.0);
  return need_of(order.threads(), first,
                 static_cast<double>(limit(std::max(order.memory_factor(), 1.0))) / static_cast<double>(first),
                 jobs::predicted_seconds(job, {order.threads(), 0}, order.threads(), step_cost_));
}

std::shared_ptr<Submission> SlurmExecutor::open_attempt(const store::JobFolder& folder, const worker::Order& order) {
  Attempt attempt;
  attempt.set_id(store::random_name());
  const Need need = predict(order, attempt);
  const AttemptFolder shared = folder_of(attempt);
  require_marker(options_.folder);
  // Durable first: whatever is in the shared folder belongs to an attempt that the next daemon finds.
  write_attempt(folder, attempt);
  try {
    const AttemptFolder partial(shared.root().string() + ".partial");
    if (const int error = store::make_own_folder(partial.root()); error != 0)
      store::throw_file_error(partial.root(), "used", error);
    write_small_file(partial.files().order(), store::put_lattice_apart(partial.files(), order).SerializeAsString());
    copy_run(folder, partial.files());
    partial.request(Request::NONE);
    if (const int error = store::rename_own(partial.root(), shared.root()); error != 0)
      store::throw_file_error(shared.root(), "written", error);
  } catch (...) {
    static_cast<void>(store::remove_own(folder.attempt()));
    static_cast<void>(store::remove_own(shared.root().string() + ".partial"));
    throw;
  }
  return batcher_.submit(attempt, folder, need);
}

jobs::WorkerExit SlurmExecutor::run(const store::JobFolder& folder, const worker::Order& order,
                                    const jobs::WorkerEvents& events, const jobs::Interruptions& interruptions) {
  // A result from the reports of lost workers takes seconds, and only this machine has all of them.
  if (order.has_given_up() || local_->has_worker(folder)) return local_->run(folder, order, events, interruptions);
  cut_incomplete_report(folder);
  std::shared_ptr<Submission> submission;
  if (auto attempt = read_attempt(folder)) {
    const bool is_known = attempt->slurm_job() != 0;
    if (!attempt->batch().empty() && folder_of(*attempt).exists()) {
      submission = std::make_shared<Submission>(*std::move(attempt),
                                                is_known ? Submission::Stage::answered : Submission::Stage::lost);
    } else {
      // It was not handed to sbatch, or was taken back.
      end_worker(folder);
    }
  }
  if (!submission) submission = open_attempt(folder, order);
  const std::function<void(const Attempt&, bool)> closed = [this](const Attempt& attempt, bool has_begun) {
    tidy_up_after(attempt, has_begun);
  };
  try {
    AttemptFollower follower({options_, commands_, view_, events, interruptions, closed}, folder, submission);
    return follower.follow();
  } catch (const std::exception& error) {
    // What this machine lacks at the moment is no reason to stop work in the cluster: it is adopted later.
    if (trouble_of(error)) throw;
    give_up(folder, *submission);
    throw;
  } catch (...) {
    give_up(folder, *submission);
    throw;
  }
}

void SlurmExecutor::give_up(const store::JobFolder& folder, Submission& submission) {
  static_cast<void>(submission.withdraw());
  // The job's folder may be gone by now.
  end_attempt(folder, submission.state().attempt);
  submission.close(folder);
}

}  // namespace cellcrush::slurm
