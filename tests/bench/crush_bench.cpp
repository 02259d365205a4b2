// Whole crushes, each in a process of its own: time all in and memory, and how both grow with the lattice.
//   crush_bench                                       all: some minutes
//   crush_bench --benchmark_filter=whole              Type I to 80 % strain, by every kernel
//   crush_bench --benchmark_filter=cells --chart=FILE.svg   1, 4, 16, 64 times the cells to 20 % strain
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>

#include "bench/bench_flags.h"
#include "bench/growth_chart.h"
#include "bench/whole_crush.h"
#include "cellcrush/simd.h"
#include "scenes/crushes.h"

namespace cellcrush::bench {
namespace {

constexpr int kMostTimes = 64;
constexpr double kGrowthStrain = 0.20;
/// Small lattices are crushed as often as makes so many times the cells, some seconds, as what others do on the machine
/// comes and goes.
constexpr int kCellsTimed = 16;
constexpr double kMegabyte = 1e6;

/// Times are summed, memory is that of the one that took most.
void add_cost(const CrushCost& cost, CrushCost& sum) {
  sum.elements = cost.elements;
  sum.steps += cost.steps;
  sum.seconds += cost.seconds;
  sum.build_seconds += cost.build_seconds;
  for (int i = 0; i < kStageCount; ++i) {
    sum.stage_seconds[i] += cost.stage_seconds[i];
  }
  if (cost.peak_bytes > sum.peak_bytes) {
    sum.base_bytes = cost.base_bytes;
    sum.build_bytes = cost.build_bytes;
    sum.peak_bytes = cost.peak_bytes;
    sum.scene_bytes = cost.scene_bytes;
    sum.state_bytes = cost.state_bytes;
  }
}

/// The mean of as many crushes as there are iterations.
void time_whole(benchmark::State& bench, const SceneSpec& spec, const std::string& target) {
  CrushCost sum;
  for (auto _ : bench) {
    try {
      const CrushCost cost = crush_apart(spec, target);
      bench.SetIterationTime(cost.seconds);
      add_cost(cost, sum);
    } catch (const std::exception& error) {
      bench.SkipWithError(error.what());
      return;
    }
  }
  const auto crushes = static_cast<double>(bench.iterations());
  const double nanoseconds = 1e9 / (sum.steps * sum.elements);
  bench.counters["elements"] = sum.elements;
  bench.counters["steps"] = sum.steps / crushes;
  bench.counters["seconds"] = sum.seconds / crushes;
  bench.counters["build_seconds"] = sum.build_seconds / crushes;
  bench.counters["element_step_ns"] = sum.seconds * nanoseconds;
  for (int i = 0; i < kStageCount; ++i) {
    bench.counters[std::string(kStageNames[i]) + "_ns"] = sum.stage_seconds[i] * nanoseconds;
  }
  bench.counters["process_mb"] = (sum.base_bytes + sum.peak_bytes) / kMegabyte;
  bench.counters["bytes_an_element"] = sum.peak_bytes / sum.elements;
  bench.counters["build_bytes_an_element"] = sum.build_bytes / sum.elements;
  bench.counters["scene_array_bytes_an_element"] = sum.scene_bytes / sum.elements;
  bench.counters["state_array_bytes_an_element"] = sum.state_bytes / sum.elements;
  bench.SetLabel(target);
}

void add(const std::string& name, const SceneSpec& spec, const std::string& target, int crushes = 1) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& bench) { time_whole(bench, spec, target); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(crushes);
}

void add_all(const Flags&) {
  for (const std::string& target : simd_targets()) {
    add("whole/type-i-paper/" + target, scenes::papers_type_i(), target);
  }
  for (int times = 1; times <= kMostTimes; times *= 4) {
    SceneSpec spec = scenes::papers_type_i_wider(times);
    // Samples and frames as far apart as those of the whole crush.
    const double share = kGrowthStrain / spec.loading.end_strain;
    spec.output.sample_count = static_cast<int>(share * spec.output.sample_count);
    spec.output.frame_count = static_cast<int>(share * spec.output.frame_count);
    spec.loading.end_strain = kGrowthStrain;
    add("cells/" + std::to_string(times), spec, simd_targets().front(), std::max(1, kCellsTimed / times));
  }
}

std::vector<std::string> counters() {
  std::vector<std::string> names = {"elements",
                                    "steps",
                                    "seconds",
                                    "build_seconds",
                                    "process_mb",
                                    "bytes_an_element",
                                    "build_bytes_an_element",
                                    "scene_array_bytes_an_element",
                                    "state_array_bytes_an_element",
                                    "element_step_ns"};
  for (const char* stage : kStageNames) names.push_back(std::string(stage) + "_ns");
  return names;
}

}  // namespace
}  // namespace cellcrush::bench

int main(int count, char** words) {
  using namespace cellcrush::bench;
  return run_benchmarks(count, words, counters(), add_all, draw_growth);
}
