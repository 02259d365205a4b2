// What a second thread gains: two runs of one crush, on one thread and on several, take turns of some steps, so that
// what others do on the machine meets both. Clock time without samples; that their bits are the same is looked at as
// well.
//   thread_bench                                   two threads, and twice as many up to those that the machine has
//   cores for thread_bench --benchmark_filter=type-i-paper   one lattice
//   thread_bench --csv=FILE --commit=NAME          with rows for a table
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bench/bench_program.h"
#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"
#include "worker/large_pages.h"

namespace cellcrush::bench {
namespace {

constexpr int kCrushes = 5;
constexpr std::int64_t kTurn = 100;
constexpr std::int64_t kWholeCrush = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kStepsOfLarge = 1000;

/// Clock seconds of the same steps.
struct Turns {
  double alone = 0.0;
  double threaded = 0.0;
  double steps = 0.0;
  bool same_bits = false;

  [[nodiscard]] double gain() const { return alone / threaded; }
};

double seconds_of_turn(Simulation& simulation, std::int64_t steps) {
  const auto start = std::chrono::steady_clock::now();
  simulation.advance(steps);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Turns take_turns(const std::shared_ptr<const Scene>& scene, int threads, std::int64_t steps) {
  Simulation alone(scene);
  Simulation threaded(scene, threads);
  worker::use_large_pages(alone);
  worker::use_large_pages(threaded);
  Turns turns;
  while (alone.status().kind == RunStatus::Kind::running && alone.step() < steps) {
    const std::int64_t turn = std::min(kTurn, steps - alone.step());
    turns.alone += seconds_of_turn(alone, turn);
    turns.threaded += seconds_of_turn(threaded, turn);
  }
  turns.steps = static_cast<double>(alone.step());
  turns.same_bits = scenes::hash_of(alone.state()) == scenes::hash_of(threaded.state());
  return turns;
}

void time_threads(benchmark::State& bench, const SceneSpec& spec, int threads, std::int64_t steps) {
  use_simd_target(simd_targets().front());
  const auto scene = scenes::build(spec);
  std::vector<Turns> crushes;
  for (auto _ : bench) {
    crushes.push_back(take_turns(scene, threads, steps));
    bench.SetIterationTime(crushes.back().threaded);
    if (!crushes.back().same_bits) {
      bench.SkipWithError("the bits depend on the number of threads.");
      return;
    }
  }
  std::sort(crushes.begin(), crushes.end(), [](const Turns& a, const Turns& b) { return a.gain() < b.gain(); });
  const Turns& median = crushes[crushes.size() / 2];
  const auto elements = static_cast<double>(scene->element_count());
  bench.counters["elements"] = elements;
  bench.counters["threads"] = threads;
  bench.counters["steps"] = median.steps;
  bench.counters["one_thread_ns"] = 1e9 * median.alone / (median.steps * elements);
  bench.counters["element_step_ns"] = 1e9 * median.threaded / (median.steps * elements);
  bench.counters["times_as_fast"] = median.gain();
  bench.counters["least_times_as_fast"] = crushes.front().gain();
  bench.counters["most_times_as_fast"] = crushes.back().gain();
  bench.SetLabel(simd_targets().front());
}

void add(const std::string& name, const SceneSpec& spec, std::int64_t steps) {
  const int cores = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
  for (int threads = 2; threads <= cores; threads *= 2) {
    benchmark::RegisterBenchmark(("threads/" + name + "/" + std::to_string(threads)).c_str(),
                                 [=](benchmark::State& bench) { time_threads(bench, spec, threads, steps); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->Iterations(kCrushes);
  }
}

void add_all(const Flags&) {
  add("type-i-paper", scenes::papers_type_i(), kWholeCrush);
  add("cells/16", scenes::papers_type_i_wider(16), kStepsOfLarge);
}

}  // namespace
}  // namespace cellcrush::bench

int main(int count, char** words) {
  using namespace cellcrush::bench;
  return run_benchmarks(count, words, add_all, draw_nothing);
}
