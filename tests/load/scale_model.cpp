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

// Five jobs a slot: a start together, then ends at all times.
Workload workload_of(const Setting& setting, double run_s, int slots) {
  Workload out;
  out.slots = slots;
  out.jobs = std::max(5 * slots, 100);
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

int find_limit(const Setting& setting, double run_s, const DaemonCosts& costs) {
  const auto is_kept_busy = [&](int slots) {
    const Workload workload = workload_of(setting, run_s, slots);
    return share_of_ideal(workload, simulate(workload, costs)) >= kKeptBusy;
  };
  if (is_kept_busy(kMostSlots)) return kMostSlots;
  int low = 0;
  int high = kMostSlots;
  while (high - low > std::max(1, low / 50)) {
    const int middle =
        low < 8 ? (low + high) / (low == 0 && high > 64 ? 8 : 2) : static_cast<int>(std::sqrt(1.0 * low * high));
    (is_kept_busy(middle) ? low : high) = middle;
  }
  return low;
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
  draw_limits(chart, curves, kMostSlots);
}

void predict(const DaemonCosts& costs, int jobs, int workers, double cores) {
  const Outcome outcome = simulate(small_jobs(jobs, workers, cores, costs), costs);
  fmt::print("what,predicted\nmakespan_s,{:.1f}\ndaemon_cpu_s,{:.2f}\njournal_mb,{:.3f}\nresults_mb,{:.3f}\n",
             outcome.makespan_s, outcome.daemon_cpu_s, 1e-6 * outcome.journal_bytes, 1e-6 * outcome.result_bytes);
  fmt::print("events_per_s,{:.1f}\njournal_share,{:.3f}\nchange_latency_ms,{:.2f}\n", outcome.events_per_s,
             outcome.journal_share, 1e3 * outcome.change_latency_s);
}

int work(const std::vector<std::string>& words) {
  if (words.size() == 5 && words[1] == "predict") {
    predict(read_costs(words[0]), std::atoi(words[2].c_str()), std::atoi(words[3].c_str()),
            std::atof(words[4].c_str()));
    return 0;
  }
  if (words.size() == 4 && words[1] == "limits") {
    write_limits(read_costs(words[0]), words[2], words[3]);
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
