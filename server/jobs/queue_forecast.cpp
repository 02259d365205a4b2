#include "jobs/queue_forecast.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>

#include "cellcrush/simulation.h"
#include "jobs/waiting_jobs.h"
#include "store/resource_name.h"
#include "translate/presets.h"
#include "worker/stage_timer.h"

namespace cellcrush::jobs {
namespace {

// What one more core is worth: two take .72 to .9 of the time of one, by the size of the lattice (README.md).
constexpr double kWorthOfAnotherCore = 0.25;

// Element-steps of the reference crush that take as long as one of the first third of the preset's own crush.
constexpr double kOverReference = 1.65;
constexpr int kMeasurements = 9;  // the median counts: others may use the core in between
constexpr std::int64_t kStepsMeasured = 128;
// Fallback if the preset does not build: the cost on a core of 2022.
constexpr double kUnmeasured = 1e-7;

std::string before_it(int count, const char* joint) {
  if (count == 0) return ".";
  return joint + std::to_string(count) + (count == 1 ? " job starts before it." : " jobs start before it.");
}

std::string all_workers(const WorkerFacts& workers) {
  const std::string count = std::to_string(workers.count);
  if (!workers.are_cores())
    return workers.executor + " has " + count + (workers.count == 1 ? " job" : " jobs") + ", as many as it may";
  return workers.count == 1 ? "The only worker is busy" : "All " + count + " workers are busy";
}

std::string at_its_limit(const store::QueuedJob& job) {
  const std::string limit = std::to_string(job.max_parallel) + (job.max_parallel == 1 ? " job" : " jobs");
  return "Its sweep, " + store::sweep_name_of(job.sweep) + ", is already running the " + limit +
         " that max_parallel allows";
}

std::string at_its_owners_limit(const store::QueuedJob& job, int most) {
  return "Its owner, " + job.owner + ", is already running the " + std::to_string(most) +
         (most == 1 ? " job" : " jobs") + " that --owner-max-running allows";
}

// Simulates the workers over time.
class Play {
 public:
  Play(const std::vector<RunningJob>& running, const std::vector<store::QueuedJob>& waiting, const WorkerFacts& workers,
       const FactsOf& facts_of)
      : workers_(workers),
        facts_of_(facts_of),
        free_(workers.count),
        waiting_(workers.owner_max_running),
        now_(workers.owner_max_running) {
    for (const auto& [job, seconds_left, cores] : running) {
      waiting_.count_running(job, cores);
      now_.count_running(job, cores);
      begin(job, seconds_left, cores);
    }
    for (const auto& job : waiting) waiting_.add(job);
    all_busy_ = free_ <= 0;
  }

  // The next job that starts, and when; false when there is none.
  bool next(store::QueuedJob& job, double& seconds) {
    while (true) {
      if (free_ > 0) {
        if (const auto taken = waiting_.take()) {
          job = *taken;
          seconds = time_;
          const JobFacts facts = facts_of_(job.job);
          const int cores = workers_.are_cores() ? 1 + extra_cores(facts.threads, free_ - 1, waiting_.count())
                                                 : std::max(facts.threads, 1);
          waiting_.add_cores(job, cores - 1);
          begin(job, predicted_seconds(job, facts, cores, workers_.step_cost), cores);
          return true;
        }
      }
      if (ends_.empty()) return false;
      const End& end = ends_.top();
      time_ = std::max(time_, end.time);
      waiting_.give_back(end.job, end.cores);
      free_ += held_by(end.cores);
      ends_.pop();
    }
  }

  // Why a job with `before` others ahead of it does not run now.
  [[nodiscard]] std::string reason(const store::QueuedJob& job, double seconds, int before) const {
    if (!workers_.held.empty()) return "The queue is held: " + workers_.held;
    switch (now_.limit_of(job)) {
      case WaitingJobs::Limit::sweep: return at_its_limit(job) + before_it(before, ", and ");
      case WaitingJobs::Limit::owner:
        return at_its_owners_limit(job, workers_.owner_max_running) + before_it(before, ", and ");
      case WaitingJobs::Limit::none: break;
    }
    if (all_busy_) return all_workers(workers_) + before_it(before, ", and ");
    if (seconds > 0.0) return before_it(before, "");
    return workers_.are_cores() ? "A worker is starting it now." : workers_.executor + " takes it now.";
  }

 private:
  struct End {
    double time;
    store::QueuedJob job;
    int cores;
  };
  struct Later {
    bool operator()(const End& one, const End& other) const { return one.time > other.time; }
  };

  [[nodiscard]] int held_by(int cores) const { return workers_.are_cores() ? cores : 1; }

  void begin(const store::QueuedJob& job, double seconds, int cores) {
    ends_.push({time_ + seconds, job, cores});
    free_ -= held_by(cores);
  }

  WorkerFacts workers_;
  const FactsOf& facts_of_;
  int free_;  ///< of the workers
  WaitingJobs waiting_;
  WaitingJobs now_;  ///< jobs that run before anything else starts
  bool all_busy_ = false;
  double time_ = 0.0;
  std::priority_queue<End, std::vector<End>, Later> ends_;
};

}  // namespace

double measure_step_cost() {
  // In a smaller lattice the outer walls, which fill no vectors, and the plates would dominate.
  const translate::Preset* preset = translate::find_preset("hexagon-small");
  if (preset == nullptr) return kUnmeasured;
  const auto built = build_scene(preset->spec);
  if (!built.scene) return kUnmeasured;
  Simulation simulation(built.scene);
  simulation.advance(2 * kStepsMeasured);
  std::array<double, kMeasurements> seconds{};
  for (double& taken : seconds) {
    const double start = worker::processor_seconds(CLOCK_THREAD_CPUTIME_ID);
    simulation.advance(kStepsMeasured);
    taken = worker::processor_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
  }
  std::ranges::nth_element(seconds, seconds.begin() + kMeasurements / 2);
  const auto element_steps = static_cast<double>(kStepsMeasured * facts_of(*built.scene).element_count);
  return seconds[kMeasurements / 2] / (kOverReference * element_steps);
}

double predicted_seconds(const store::QueuedJob& job, const JobFacts& facts, int cores, double step_cost) {
  const double left = static_cast<double>(job.element_steps) * std::clamp(1.0 - facts.done, 0.0, 1.0);
  return step_cost * left / (1.0 + kWorthOfAnotherCore * (cores - 1));
}

int extra_cores(int threads, int free, std::size_t waiting) {
  return std::clamp(threads - 1, 0, std::max(free - static_cast<int>(waiting), 0));
}

v1::Queue forecast_queue(const std::vector<RunningJob>& running, const std::vector<store::QueuedJob>& waiting,
                         const WorkerFacts& workers, const FactsOf& facts_of) {
  Play play(running, waiting, workers, facts_of);
  v1::Queue out;
  store::QueuedJob job;
  double seconds = 0.0;
  while (out.entries_size() < kMostEntries && play.next(job, seconds)) {
    const int before = out.entries_size();
    auto& entry = *out.add_entries();
    entry.set_job(store::name_of(job.job));
    entry.set_reason(play.reason(job, seconds, before));
    entry.set_seconds_until_start(seconds);
    entry.set_priority(job.priority);
    entry.set_executor(workers.executor);
  }
  out.set_more_count(static_cast<int>(waiting.size()) - out.entries_size());
  return out;
}

}  // namespace cellcrush::jobs
