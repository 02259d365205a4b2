#include "load/queue_model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <random>
#include <vector>

namespace cellcrush::load {
namespace {

constexpr double kBetweenSampleCommits = 1.0;  // s, Journal::kLazyCommit
constexpr double kStatesOfAJob = 3.0;          // PENDING, RUNNING and the last

class Simulation {
 public:
  Simulation(const Workload& workload, const DaemonCosts& costs)
      : workload_(workload), costs_(costs), random_(workload.seed), waiting_(workload.jobs) {
    const double variance = std::log1p(workload.run_spread * workload.run_spread);
    run_ = std::lognormal_distribution<double>(std::log(workload.run_s) - 0.5 * variance, std::sqrt(variance));
    const int processors = std::max(1, static_cast<int>(workload.daemon_cores));
    for (int i = 0; i < processors; ++i) processors_.push(0.0);
  }

  Outcome run() {
    for (int i = 0; i < std::min(workload_.slots, workload_.jobs); ++i) take_job();
    at(kBetweenSampleCommits, [this] { commit_samples(); });
    while (ended_ < workload_.jobs) {
      const auto next = events_.top();
      events_.pop();
      now_ = next.time;
      next.act();
    }
    return outcome();
  }

 private:
  struct Event {
    double time;
    std::uint64_t number;  // in the order of their planning, for equal times
    std::function<void()> act;
    bool operator<(const Event& other) const { return time != other.time ? time > other.time : number > other.number; }
  };
  struct Write {
    double asked;
    double seconds;
    std::function<void()> then;
  };

  void at(double time, std::function<void()> act) { events_.push({time, planned_++, std::move(act)}); }

  // How much slower all is while workers and daemon want more cores than there are.
  [[nodiscard]] double stretch() const {
    if (workload_.shared_cores <= 0.0) return 1.0;
    const double daemon = now_ > 0.0 ? cpu_ / now_ : 0.0;
    return std::max(1.0, (running_ + 1.0 + daemon) / workload_.shared_cores);
  }

  void take_job() {
    if (waiting_ == 0) return;
    --waiting_;
    const double start = std::max(now_, next_start_);
    next_start_ = start + workload_.start_interval_s;
    at(start, [this] { work(0.5 * costs_.job_cpu_s, [this] { write(costs_.change_s, [this] { begin(); }); }); });
  }

  // The daemon's own processors do it, one piece of work after the other.
  void work(double seconds, std::function<void()> then) {
    cpu_ += seconds;
    const double begin = std::max(now_, processors_.top());
    processors_.pop();
    processors_.push(begin + seconds * speed_loss());
    at(begin + seconds * speed_loss(), std::move(then));
  }

  // Threads that follow running jobs share the processors with it.
  [[nodiscard]] double speed_loss() const {
    return std::max(1.0, (following_cores() + 1.0) / std::max(1.0, workload_.daemon_cores));
  }

  [[nodiscard]] double sample_rate() const { return running_ * workload_.samples / workload_.run_s; }

  [[nodiscard]] double following_cores() const {
    return running_ * costs_.follow_cpu_s +
           sample_rate() * (costs_.sample_cpu_s + workload_.watchers * costs_.watch_cpu_s);
  }

  void begin() {
    const double run = run_(random_);
    const double seconds = (run + costs_.slot_gap_s) * stretch();
    ++running_;
    busy_ += run;
    cpu_ += workload_.samples * (costs_.sample_cpu_s + workload_.watchers * costs_.watch_cpu_s) +
            seconds * costs_.follow_cpu_s;
    at(now_ + seconds, [this] {
      --running_;
      work(0.5 * costs_.job_cpu_s, [this] { write(costs_.change_s, [this] { end(); }); });
    });
  }

  void end() {
    ++ended_;
    last_end_ = now_;
    take_job();
  }

  void commit_samples() {
    const double count = sample_rate() * (now_ - samples_committed_);
    samples_committed_ = now_;
    if (count <= 0.0) {
      at(now_ + kBetweenSampleCommits, [this] { commit_samples(); });
      return;
    }
    write(count * costs_.sample_commit_s,
          [this, asked = now_] { at(std::max(now_, asked + kBetweenSampleCommits), [this] { commit_samples(); }); });
  }

  void write(double seconds, std::function<void()> then) {
    writes_.push_back({now_, seconds, std::move(then)});
    if (!committing_) commit();
  }

  // One commit for all that wait.
  void commit() {
    committing_ = true;
    std::vector<Write> batch;
    batch.swap(writes_);
    double seconds = costs_.commit_s;
    for (const auto& each : batch) seconds += each.seconds;
    turn_ += seconds;
    at(now_ + seconds, [this, batch = std::move(batch)] {
      for (const auto& each : batch) {
        latency_ += now_ - each.asked;
        longest_ = std::max(longest_, now_ - each.asked);
        ++writes_done_;
        each.then();
      }
      committing_ = false;
      if (!writes_.empty()) commit();
    });
  }

  [[nodiscard]] Outcome outcome() const {
    Outcome out;
    out.makespan_s = last_end_;
    out.jobs_per_s = workload_.jobs / last_end_;
    out.busy_share = busy_ / (last_end_ * workload_.slots);
    out.daemon_cpu_s = cpu_;
    out.daemon_cores = cpu_ / last_end_;
    out.journal_share = turn_ / last_end_;
    out.events_per_s = workload_.jobs * (kStatesOfAJob + workload_.samples) / last_end_;
    out.change_latency_s = latency_ / static_cast<double>(writes_done_);
    out.longest_latency_s = longest_;
    out.journal_bytes = workload_.jobs * (costs_.job_journal_bytes + workload_.samples * costs_.sample_journal_bytes);
    out.result_bytes = workload_.jobs * (costs_.job_result_bytes + workload_.samples * costs_.sample_result_bytes);
    return out;
  }

  Workload workload_;
  DaemonCosts costs_;
  std::mt19937_64 random_;
  std::lognormal_distribution<double> run_;
  std::priority_queue<Event> events_;
  std::uint64_t planned_ = 0;
  double now_ = 0.0;
  int waiting_;
  int running_ = 0;
  int ended_ = 0;
  double next_start_ = 0.0;
  std::priority_queue<double, std::vector<double>, std::greater<>> processors_;  // when each is free
  std::vector<Write> writes_;                                                    // that wait for the journal's turn
  bool committing_ = false;
  double samples_committed_ = 0.0;
  double busy_ = 0.0;
  double cpu_ = 0.0;
  double turn_ = 0.0;
  double latency_ = 0.0;
  double longest_ = 0.0;
  std::int64_t writes_done_ = 0;
  double last_end_ = 0.0;
};

}  // namespace

Workload small_jobs(int jobs, int slots, double cores, const DaemonCosts& costs) {
  Workload out;
  out.jobs = jobs;
  out.slots = slots;
  out.run_s = costs.small_run_s;
  out.run_spread = costs.small_run_spread;
  out.samples = costs.small_samples;
  out.shared_cores = cores;
  out.daemon_cores = cores;
  return out;
}

Outcome simulate(const Workload& workload, const DaemonCosts& costs) { return Simulation(workload, costs).run(); }

}  // namespace cellcrush::load
