// Time of a step of crushed lattices, by stage and by SIMD target, each beside the plain text in the same run. An
// iteration restores the state and takes some steps; the least of them counts.
//   solver_bench                                              all
//   solver_bench --benchmark_filter=type-i-paper/45/avx512    one
//   solver_bench --csv=FILE --commit=NAME                     with rows for a table
//   solver_bench --chart=FILE                                 with a chart of what a step costs
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/bench_program.h"
#include "bench/cost_chart.h"
#include "bench/machine.h"
#include "cellcrush/scene.h"
#include "cellcrush/simd.h"
#include "cellcrush/state.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "step/advance_step.h"
#include "worker/stage_timer.h"

namespace cellcrush::bench {
namespace {

std::runtime_error broken(const std::filesystem::path& file, const char* what) {
  return std::runtime_error(file.string() + ": " + what);
}

/// Writes every field of a state. The file is in its place only once it is whole.
void save_state(const std::filesystem::path& file, const State& state) {
  std::filesystem::create_directories(file.parent_path());
  std::string bytes;
  ByteWriter writer(append_to(bytes));
  put_state(writer, state);
  const std::filesystem::path partial = file.string() + ".partial";
  {
    std::ofstream stream(partial, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.flush();
    if (!stream) throw broken(file, "cannot be written; give --states a folder that can.");
  }
  std::filesystem::rename(partial, file);
}

/// The state of a file that this same program wrote; nothing when there is no such file.
std::optional<State> load_state(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  const std::string read = std::move(bytes).str();
  ByteReader reader(source_of(read));
  State state;
  take_state(reader, state);
  if (!reader.sound() || !reader.at_end()) throw broken(file, "is cut short; remove it.");
  return state;
}

/// States of crushes at the strains at which they are timed. Each crush runs once, by the best kernel, when first asked
/// for; with a folder its states are kept there for the next time that this same build runs.
class CrushedStates {
 public:
  explicit CrushedStates(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Crushed {
    std::shared_ptr<const Scene> scene;
    State state;
  };
  /// REQUIRES: `strain` is one of the crush's.
  const Crushed& at(const scenes::Crush& crush, double strain) {
    if (!crushed_.contains(crush.name)) run(crush);
    return crushed_.at(crush.name).at(strain);
  }

 private:
  void run(const scenes::Crush& crush);

  std::filesystem::path folder_;  ///< empty: nothing is kept
  std::map<std::string, std::map<double, Crushed>> crushed_;
};

void CrushedStates::run(const scenes::Crush& crush) {
  static const std::string kBuild = build_name();
  const std::string target = simd_target();
  use_simd_target("");
  const auto scene = scenes::build(crush.spec);
  std::map<double, Crushed>& states = crushed_[crush.name];
  Simulation simulation(scene);
  for (const double strain : crush.strains) {
    const std::string name = crush.name + "-" + std::to_string(std::lround(100.0 * strain)) + "-" + kBuild + ".state";
    std::optional<State> kept = folder_.empty() ? std::nullopt : load_state(folder_ / name);
    if (!kept) {
      while (simulation.strain() < strain && simulation.status().kind == RunStatus::Kind::running) {
        simulation.advance(16);
      }
      kept = simulation.state();
      if (!folder_.empty()) save_state(folder_ / name, *kept);
    }
    states[strain] = {scene, *std::move(kept)};
  }
  use_simd_target(target);
}

constexpr int kIterations = 7;
constexpr double kElementSteps = 1e6;  ///< of an iteration
constexpr int kTimedSteps = 5;         ///< one in so many, for the split by stage

/// Processor time of an element-step, ns, and its parts.
struct Cost {
  double all = 0.0;
  std::array<double, kStageCount> stages{};
};

/// Steps on from a copy of the crushed state. The stages are timed in some of the steps and scaled to the time of all.
Cost time_steps(const CrushedStates::Crushed& crushed, const std::string& target) {
  use_simd_target(target);
  const auto elements = static_cast<double>(crushed.scene->element_count());
  const int steps = std::max(20, static_cast<int>(kElementSteps / elements));
  State state = crushed.state;
  worker::StageTimer timer(kTimedSteps);
  const double start = processor_seconds();
  for (int i = 0; i < steps; ++i) {
    advance_step(*crushed.scene, state, &timer);
  }
  Cost cost;
  cost.all = 1e9 * (processor_seconds() - start) / (steps * elements);
  cost.stages = timer.seconds();
  double sum = 0.0;
  for (const double seconds : cost.stages) sum += seconds;
  for (double& stage : cost.stages) stage *= cost.all / sum;
  return cost;
}

bool is_less(const Cost& one, const Cost& other) { return one.all < other.all; }

void time_crush(benchmark::State& bench, CrushedStates& states, const scenes::Crush& crush, double strain,
                const std::string& target) {
  const CrushedStates::Crushed& crushed = states.at(crush, strain);
  std::vector<Cost> costs;
  std::vector<Cost> plain;
  for (auto _ : bench) {
    costs.push_back(time_steps(crushed, target));
    plain.push_back(target == "scalar" ? costs.back() : time_steps(crushed, "scalar"));
    bench.SetIterationTime(1e-9 * costs.back().all);
  }
  std::sort(costs.begin(), costs.end(), is_less);
  const Cost& least = costs.front();
  const double scalar = std::min_element(plain.begin(), plain.end(), is_less)->all;
  bench.counters["element_step_ns"] = least.all;
  for (int i = 0; i < kStageCount; ++i) {
    bench.counters[std::string(kStageNames[i]) + "_ns"] = least.stages[i];
  }
  bench.counters["scalar_ns"] = scalar;
  bench.counters["times_as_fast_as_scalar"] = scalar / least.all;
  bench.counters["spread"] = costs[costs.size() / 2].all / least.all - 1.0;
  bench.counters["elements"] = static_cast<double>(crushed.scene->element_count());
  bench.SetLabel(target);
}

void add_all(const Flags& flags) {
  const auto states = std::make_shared<CrushedStates>(flags.states);
  for (const scenes::Crush& crush : scenes::crushes()) {
    for (const double strain : crush.strains) {
      for (const std::string& target : simd_targets()) {
        const std::string name = crush.name + "/" + std::to_string(std::lround(100.0 * strain)) + "/" + target;
        benchmark::RegisterBenchmark(
            name.c_str(), [=](benchmark::State& bench) { time_crush(bench, *states, crush, strain, target); })
            ->Unit(benchmark::kNanosecond)
            ->UseManualTime()
            ->Iterations(kIterations);
      }
    }
  }
}

}  // namespace
}  // namespace cellcrush::bench

int main(int count, char** words) {
  using namespace cellcrush::bench;
  return run_benchmarks(count, words, add_all, draw_costs);
}
