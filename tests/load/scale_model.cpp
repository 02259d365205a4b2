// Simulates the queue of one daemon from measured figures.
// usage: scale_model FIGURES.csv predict JOBS WORKERS CORES   what a run of small jobs takes on the measured machine
//        scale_model FIGURES.csv limits TABLE.csv CHART.svg   where one daemon ends, for 1 to 10,000 slots
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "load/queue_model.h"
#include "load/scale_chart.h"

namespace cellcrush::load {
namespace {

constexpr double kKeptBusy = 0.9;
constexpr int kMostSlots = 10'000;
constexpr double kDaemonCores = 2.0;
constexpr double kSpread = 0.2;
constexpr std::array<double, 8> kRunTimes = {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3600.0};
constexpr std::array<int, 5> kSlots = {1, 10, 100, 1000, kMostSlots};

struct Setting {
  const char* name;
  double samples;
  int watchers;
  double start_interval_s;
};
// Slurm starts a task of an array every 0.5 s or so: assumed, not measured here.
constexpr std::array<Setting, 4> kSettings = {{{"1000 samples a job", 1000.0, 0, 0.0},
                                               {"1000 samples, 100 watchers of all jobs", 1000.0, 100, 0.0},
                                               {"20 samples a job", 20.0, 0, 0.0},
                                               {"1000 samples, a start every 0.5 s (Slurm array)", 1000.0, 0, 0.5}}};

// Three jobs a slot: a start together, then ends at all times.
Workload workload_of(const Setting& setting, double run_s, int slots) {
  Workload out;
  out.slots = slots;
  out.jobs = std::max(3 * slots, 60);
  out.run_s = run_s;
  out.run_spread = kSpread;
  out.samples = setting.samples;
  out.watchers = setting.watchers;
  out.start_interval_s = setting.start_interval_s;
  out.daemon_cores = kDaemonCores;
  return out;
}

// The share of the speed of a daemon whose work takes no time.
double share_of_ideal(const Workload& workload, const Outcome& outcome) {
  Workload ideal = workload;
  ideal.start_interval_s = 0.0;
  return simulate(ideal, {}).makespan_s / outcome.makespan_s;
}

const char* first_full(const Setting& setting, const Outcome& outcome) {
  if (setting.start_interval_s > 0.0 && outcome.jobs_per_s * setting.start_interval_s > 0.9) return "batch system";
  return outcome.journal_share > outcome.daemon_cores / kDaemonCores ? "journal" : "processor";
}

// Slots that would take more of the processors or of the journal's turn than there is; nothing needs to be simulated.
bool is_beyond(const Workload& workload, const DaemonCosts& costs) {
  const double jobs_per_s = workload.slots / (workload.run_s + costs.slot_gap_s);
  const double samples_per_s = jobs_per_s * workload.samples;
  const double cores = workload.slots * costs.follow_cpu_s + jobs_per_s * costs.job_cpu_s +
                       samples_per_s * (costs.sample_cpu_s + workload.watchers * costs.watch_cpu_s);
  const double turn = 2.0 * jobs_per_s * costs.change_s + samples_per_s * costs.sample_commit_s;
  return kKeptBusy * std::max(cores / workload.daemon_cores, turn) > 1.0 ||
         kKeptBusy * jobs_per_s * workload.start_interval_s > 1.0;
}

// By bisection; the ratio of its ends is then below 1.05.
int find_limit(const Setting& setting, double run_s, const DaemonCosts& costs) {
  const auto is_kept_busy = [&](double slots) {
    const Workload workload = workload_of(setting, run_s, static_cast<int>(slots));
    return !is_beyond(workload, costs) && share_of_ideal(workload, simulate(workload, costs)) >= kKeptBusy;
  };
  if (is_kept_busy(kMostSlots)) return kMostSlots;
  if (!is_kept_busy(1.0)) return 0;
  double low = 1.0;
  double high = kMostSlots;
  while (high > 1.05 * low && high - low > 1.0) {
    const double middle = std::sqrt(low * high);
    (is_kept_busy(middle) ? low : high) = middle;
  }
  return static_cast<int>(low);
}

void write_limits(const DaemonCosts& costs, const std::string& table, const std::string& chart) {
  std::ofstream out(table);
  out << "setting,run_s,slots,share_of_ideal,jobs_per_s,events_per_s,daemon_cores,journal_share,change_latency_ms,"
         "journal_mb_per_h,results_mb_per_h,first_full\n";
  std::vector<LimitCurve> curves;
  for (const auto& setting : kSettings) {
    LimitCurve& curve = curves.emplace_back(LimitCurve{setting.name, {}, {}});
    for (const double run_s : kRunTimes) {
      const int limit = find_limit(setting, run_s, costs);
      if (limit > 0) {
        curve.run_s.push_back(run_s);
        curve.slots.push_back(limit);
      }
      std::vector<int> slots(kSlots.begin(), kSlots.end());
      if (limit > 0 && limit < kMostSlots) slots.push_back(limit);
      std::sort(slots.begin(), slots.end());
      for (const int count : slots) {
        const Workload workload = workload_of(setting, run_s, count);
        if (is_beyond(workload, costs)) continue;
        const Outcome outcome = simulate(workload, costs);
        const double per_hour = 3600.0 / outcome.makespan_s * 1e-6;
        out << fmt::format("\"{}\",{:g},{},{:.3f},{:.4g},{:.4g},{:.3g},{:.3g},{:.3g},{:.4g},{:.4g},{}\n", setting.name,
                           run_s, count, share_of_ideal(workload, outcome), outcome.jobs_per_s, outcome.events_per_s,
                           outcome.daemon_cores, outcome.journal_share, 1e3 * outcome.change_latency_s,
                           per_hour * outcome.journal_bytes, per_hour * outcome.result_bytes,
                           first_full(setting, outcome));
      }
    }
  }
  out.flush();
  if (!out) throw std::runtime_error(table + " cannot be written; give a file in a folder that exists.");
  draw_limits(chart, curves);
}

// From the medians of the figures, and from all that were lowest and greatest.
void predict(const std::string& figures, int jobs, int workers, double cores) {
  constexpr std::array<const char*, 3> kColumns = {"median", "lowest", "greatest"};
  std::array<Outcome, 3> outcomes;
  std::transform(kColumns.begin(), kColumns.end(), outcomes.begin(), [&](const char* column) {
    const DaemonCosts costs = read_costs(figures, column);
    return simulate(small_jobs(jobs, workers, cores, costs), costs);
  });
  const auto print = [&](const char* what, double Outcome::*value, double factor) {
    fmt::print("{}", what);
    for (const auto& outcome : outcomes) fmt::print(",{:.4g}", factor * outcome.*value);
    fmt::print("\n");
  };
  fmt::print("what,of_medians,of_lowest,of_greatest\n");
  print("makespan_s", &Outcome::makespan_s, 1.0);
  print("daemon_cpu_s", &Outcome::daemon_cpu_s, 1.0);
  print("journal_mb", &Outcome::journal_bytes, 1e-6);
  print("results_mb", &Outcome::result_bytes, 1e-6);
  print("events_per_s", &Outcome::events_per_s, 1.0);
  print("journal_share", &Outcome::journal_share, 1.0);
  print("change_latency_ms", &Outcome::change_latency_s, 1e3);
}

int work(const std::vector<std::string>& words) {
  if (words.size() == 5 && words[1] == "predict") {
    predict(words[0], std::atoi(words[2].c_str()), std::atoi(words[3].c_str()), std::atof(words[4].c_str()));
    return 0;
  }
  if (words.size() == 4 && words[1] == "limits") {
    write_limits(read_costs(words[0], "median"), words[2], words[3]);
    return 0;
  }
  fmt::print(stderr,
             "usage: scale_model FIGURES.csv predict JOBS WORKERS CORES\n"
             "       scale_model FIGURES.csv limits TABLE.csv CHART.svg\n");
  return 2;
}

}  // namespace
}  // namespace cellcrush::load

int main(int count, char** words) {
  try {
    return cellcrush::load::work({words + 1, words + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
