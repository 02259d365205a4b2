#include "jobs/queues.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "error.h"
#include "jobs/outcome.h"
#include "store/job_state.h"
#include "store/own_folder.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {
namespace {

// How the log names the queue of an executor.
std::string queue_name(const std::string& executor) {
  return executor == store::kLocalExecutor ? "The queue" : "The queue of " + executor;
}

constexpr std::size_t kCancelledAtOnce = 1000;  // jobs, in one transaction of some 20 ms

// Entries that belong to the file system.
constexpr const char* kOfTheFileSystem = "lost+found";

// Why the folder is unusable for workers; empty if it is usable.
std::string why_unusable(const store::JobFolder& folder) {
  auto status = store::find_own(folder.root());
  if (!status || !S_ISDIR(status->st_mode)) return "it is not a folder";
  if (::access(folder.root().c_str(), R_OK | W_OK | X_OK) != 0)
    return "the daemon lacks permission to read and write it";
  for (const auto& path :
       {folder.order(), folder.claim(), folder.reports(), folder.checkpoint(), folder.previous_checkpoint(),
        folder.partial_checkpoint(), folder.result(), folder.partial_result(), folder.attempt()}) {
    status = store::find_own(path);
    if (!status) continue;
    const std::string name = path.filename().string();
    if (!S_ISREG(status->st_mode)) return name + " in it is not a regular file";
    if (::access(path.c_str(), R_OK | W_OK) != 0) return name + " in it is not readable and writable";
  }
  return "";
}

std::string missing(const std::string& executor) { return executor + ", an executor that this daemon does not have"; }

}  // namespace

struct Queues::Queue {
  // Without an executor of its own it is never started, and uses none.
  Queue(const Parts& parts, NamedExecutor given, Executor& used, const std::function<void()>& tell)
      : name(std::move(given.name)),
        slots(given.slots),
        executor(std::move(given.executor)),
        hold(
            parts.hold_times,
            [this, tell](const std::vector<Hold>&) {
              tell();
              scheduler.wake();
            },
            Hold::Clock::now, queue_name(name)),
        runner({parts.folder, parts.journal, parts.reader, parts.hub, used, parts.metrics, hold,
                parts.checkpoint_interval, parts.longest_job_s, parts.most_memory_bytes, parts.step_cost,
                [this](const std::vector<std::int64_t>& stopped) {
                  scheduler.forget(stopped);
                  for (const std::int64_t job : stopped) scheduler.end_unfollowed(job);
                }}),
        scheduler({parts.folder, parts.journal, parts.reader, parts.metrics, runner, hold, used, name},
                  parts.owner_max_running) {}

  [[nodiscard]] bool is_present() const { return executor != nullptr; }

  std::string name;
  int slots;
  std::unique_ptr<Executor> executor;  ///< null if the daemon lacks it
  QueueHold hold;
  JobRunner runner;
  Scheduler scheduler;
};

void check_executors(const std::vector<std::string>& names, const std::string& default_name) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name)
      throw ServiceError(ServiceError::Kind::invalid, "Two executors are named " + *name + ". Rename one.");
  }
  if (std::ranges::find(names, default_name) == names.end()) {
    throw ServiceError(ServiceError::Kind::invalid, "--executor is \"" + default_name + "\"; this daemon has " +
                                                        fmt::format("{}", fmt::join(names, ", ")) +
                                                        ". Use one of these.");
  }
}

Queues::Queues(const Parts& parts, std::vector<NamedExecutor> executors) : parts_(parts) {
  const auto add = [this](NamedExecutor given, Executor& used) {
    queues_.push_back(std::make_unique<Queue>(parts_, std::move(given), used, [this] { tell(); }));
  };
  std::vector<std::string> executor_names;
  for (const auto& given : executors) executor_names.push_back(given.name);
  check_executors(executor_names, parts_.default_name);
  for (auto& given : executors) {
    Executor& used = *given.executor;
    add(std::move(given), used);
  }
  for (const auto& name : parts_.reader.executors_in_use()) {
    if (find(name) == nullptr) add({name, 0, nullptr}, *queues_.front()->executor);
  }
}

Queues::~Queues() { stop(); }

void Queues::start() {
  audit_folders();
  clean_up();
  for (auto& queue : queues_) queue->is_present() ? queue->scheduler.start(queue->slots) : keep(*queue);
}

// No job mistakes what belongs to no job for its own. A job whose folder is unusable restarts from step 0.
void Queues::audit_folders() {
  std::map<std::int64_t, store::QueuedJob> open;
  for (const auto state : {v1::Job::PENDING, v1::Job::RUNNING, v1::Job::SUSPENDED, v1::Job::CANCELLING}) {
    for (auto& job : parts_.reader.queued_jobs(state)) open.emplace(job.job, std::move(job));
  }
  for (const auto& name : parts_.folder.names_in_jobs()) {
    if (name == kOfTheFileSystem) continue;
    const auto job = store::number_of("jobs/" + name);
    if (!job || !parts_.reader.has_job(*job)) {
      set_aside(name, "it belongs to no job");
    } else if (const auto found = open.find(*job); found != open.end()) {
      const std::string trouble = why_unusable(parts_.folder.job_folder(*job));
      if (!trouble.empty() && end_worker(found->second)) set_aside(name, trouble);
    }
  }
}

void Queues::set_aside(const std::string& name, const std::string& why) const {
  try {
    spdlog::warn("jobs/{} was moved aside to {} because {}. Delete it when it is no longer needed.", name,
                 parts_.folder.set_aside(name).string(), why);
  } catch (const ServiceError& error) {
    spdlog::error("jobs/{} is ignored because {}, and could not be moved aside: {} Move it away by hand.", name, why,
                  error.what());
  }
}

bool Queues::end_worker(const store::QueuedJob& job) {
  const Queue* queue = find(job.executor);
  if (queue == nullptr || !queue->is_present()) return false;
  queue->executor->end_worker(parts_.folder.job_folder(job.job));
  return true;
}

// Completes the deletions of a killed daemon. What an absent executor has left is kept: a worker may still run.
void Queues::clean_up() {
  for (const std::int64_t job : parts_.folder.jobs_with_reports()) {
    try {
      const auto stored = parts_.reader.find_job(job);
      if (!stored || !store::is_terminal(stored->job.state())) continue;
      if (!end_worker({.job = job, .executor = stored->job.executor()})) continue;
      parts_.folder.clean_job_folder(job);
    } catch (const std::exception& error) {
      spdlog::warn("Leftover files of {} could not be removed; the daemon tries again at its next start: {}",
                   store::name_of(job), error.what());
    }
  }
}

void Queues::keep(Queue& queue) {
  std::size_t count = 0;
  for (const auto state : {v1::Job::PENDING, v1::Job::RUNNING, v1::Job::SUSPENDED, v1::Job::CANCELLING}) {
    const auto jobs = parts_.reader.queued_jobs(state, queue.name);
    count += jobs.size();
    if (state == v1::Job::PENDING) queue.scheduler.enqueue(jobs);
  }
  spdlog::warn("{} unfinished {} for {}. Start cellcrushd with it to run them, or cancel them.", count,
               count == 1 ? "job is" : "jobs are", missing(queue.name));
}

Queues::Queue* Queues::find(const std::string& executor) const {
  for (const auto& queue : queues_) {
    if (queue->name == executor) return queue.get();
  }
  return nullptr;
}

Queues::Queue& Queues::queue_of(std::int64_t job) {
  const auto executor = parts_.reader.executor_of(job);
  if (!executor) throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  Queue* queue = find(*executor);
  return queue != nullptr ? *queue : *queues_.front();
}

std::string Queues::names() const {
  std::string out;
  for (const auto& queue : queues_) {
    if (queue->is_present()) out += (out.empty() ? "" : ", ") + queue->name;
  }
  return out;
}

std::string Queues::executor_for(const std::string& requested, const std::string& field) const {
  if (requested.empty()) return parts_.default_name;
  const Queue* queue = find(requested);
  if (queue != nullptr && queue->is_present()) return requested;
  throw InvalidField(field, "is \"" + requested + "\"; this daemon has " + names() + ".",
                     "Use one of these, or leave it empty for " + parts_.default_name + ".");
}

void Queues::require(const std::string& executor) const {
  const Queue* queue = find(executor);
  if (queue != nullptr && queue->is_present()) return;
  throw ServiceError(ServiceError::Kind::failed_precondition,
                     "The jobs are for " + missing(executor) + ". Start cellcrushd with it first.");
}

std::vector<Queues::Standing> Queues::standings() const {
  std::vector<Standing> out;
  for (const auto& queue : queues_)
    out.push_back({queue->name, queue->slots, queue->is_present(), queue->hold.holds()});
  return out;
}

void Queues::enqueue(const std::vector<store::QueuedJob>& jobs) {
  std::map<std::string, std::vector<store::QueuedJob>> by_executor;
  for (const auto& job : jobs) by_executor[job.executor].push_back(job);
  for (const auto& [executor, own] : by_executor) find(executor)->scheduler.enqueue(own);
}

void Queues::cancel(std::int64_t job) {
  Queue& queue = queue_of(job);
  queue.scheduler.cancel(job);
  if (!queue.is_present()) end_cancelled(job, queue.name);
}

// Nobody follows the worker of a job whose executor is absent. One that has not started finds no order, and ends.
void Queues::end_cancelled(std::int64_t job, const std::string& executor) {
  static_cast<void>(store::remove_own(parts_.folder.job_folder(job).order()));
  const auto stored = parts_.reader.find_job(job);
  if (!stored || stored->job.state() != v1::Job::CANCELLING) return;
  store::StateChange change;
  change.state = v1::Job::CANCELLED;
  change.message = "The job ran on " + missing(executor) +
                   ", so it has no result. The history is kept. A worker may run there until a daemon with it starts.";
  try_change(parts_.journal, job, change);  // another call may have been first
}

void Queues::cancel_all(const std::vector<std::int64_t>& jobs) {
  cancel_waiting(jobs);
  for (const std::int64_t job : jobs) {
    const auto stored = parts_.reader.find_job(job);
    if (!stored || store::is_terminal(stored->job.state())) continue;
    try {
      cancel(job);
    } catch (const ServiceError& error) {
      // It has ended or was deleted meanwhile.
      const bool gone = error.kind() == ServiceError::Kind::not_found;
      if (!gone && error.kind() != ServiceError::Kind::failed_precondition) throw;
    }
  }
}

// All leave their queues first, so that no slot takes the next of them. The journal follows in batches, between which
// other writers have their turn.
void Queues::cancel_waiting(const std::vector<std::int64_t>& jobs) {
  for (auto& queue : queues_) queue->scheduler.dequeue(jobs);
  try {
    for (std::size_t first = 0; first < jobs.size(); first += kCancelledAtOnce) {
      const auto begin = jobs.begin() + static_cast<std::ptrdiff_t>(first);
      const auto cancelled = parts_.journal.cancel_waiting(
          {begin, begin + static_cast<std::ptrdiff_t>(std::min(kCancelledAtOnce, jobs.size() - first))});
      for (auto& queue : queues_) queue->scheduler.forget(cancelled);
      for (const std::int64_t job : cancelled) {
        Queue& queue = queue_of(job);
        if (queue.is_present())
          queue.scheduler.end_unfollowed(job);
        else
          end_cancelled(job, queue.name);
      }
    }
  } catch (...) {
    // Those that could not be cancelled wait as before.
    std::map<std::string, std::vector<store::QueuedJob>> left;
    for (const std::int64_t job : jobs) {
      if (auto queued = parts_.reader.queued_job(job, v1::Job::PENDING)) left[queued->executor].push_back(*queued);
    }
    for (auto& [executor, waiting] : left) {
      if (Queue* queue = find(executor)) queue->scheduler.requeue(waiting);
    }
    throw;
  }
}

void Queues::suspend(std::int64_t job, const std::function<bool()>& given_up) {
  Queue& queue = queue_of(job);
  const auto stored = parts_.reader.find_job(job);
  // The executor may start a job that it has, whatever the journal says.
  if (!queue.is_present() && stored && !store::is_terminal(stored->job.state()) &&
      stored->job.state() != v1::Job::SUSPENDED) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       store::name_of(job) + " is for " + missing(queue.name) +
                           ". Start cellcrushd with it to suspend the job, or cancel the job.");
  }
  queue.scheduler.suspend(job, given_up);
}

void Queues::resume(std::int64_t job) { queue_of(job).scheduler.resume(job); }

void Queues::hold_for_low_disk(const std::optional<std::string>& reason) {
  for (auto& queue : queues_) {
    if (queue->is_present()) queue->scheduler.hold_for_low_disk(reason);
  }
}

void Queues::try_now(Shortage shortage) {
  for (auto& queue : queues_) queue->hold.try_now(shortage);
}

std::size_t Queues::waiting_count() {
  std::size_t out = 0;
  for (auto& queue : queues_) out += queue->scheduler.waiting_count();
  return out;
}

std::size_t Queues::waiting_count(const std::string& owner) {
  std::size_t out = 0;
  for (auto& queue : queues_) out += queue->scheduler.waiting_count(owner);
  return out;
}

Load Queues::load() {
  Load out;
  for (auto& queue : queues_) queue->scheduler.add_load(out);
  return out;
}

int Queues::cores_of(const store::QueuedJob& job) {
  Queue* queue = find(job.executor);
  return queue == nullptr ? 1 : queue->scheduler.cores_of(job.job);
}

void Queues::stop() {
  for (auto& queue : queues_) queue->scheduler.begin_stop();
  for (auto& queue : queues_) queue->scheduler.stop();
}

// The last call sees the newest holds of all queues.
void Queues::tell() {
  const MutexLock lock(telling_);
  parts_.told(standings());
}

}  // namespace cellcrush::jobs
