// Whole crushes, each in a process of its own: time all in and memory, and how both grow with the lattice.
//   crush_bench                                       all: some minutes
//   crush_bench --benchmark_filter=whole              Type I to 80 % strain, by every kernel
//   crush_bench --benchmark_filter=cells --chart=FILE.svg   1, 4, 16, 64 times the cells to 20 % strain
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench_program.h"
#include "bench/machine.h"
#include "bench/picture_file.h"
#include "cellcrush/simd.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "chart/chart.h"
#include "chart/colour_map.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "worker/large_pages.h"
#include "worker/stage_timer.h"

namespace cellcrush::bench {
namespace {

/// What a crush took, from building the scene to its end, samples and frames included.
struct CrushCost {
  double elements = 0.0;
  double steps = 0.0;
  double strain = 0.0;                              ///< at which it ended
  double seconds = 0.0;                             ///< processor time of the run
  double build_seconds = 0.0;                       ///< processor time before it
  std::array<double, kStageCount> stage_seconds{};  ///< processor time in the stages
  double base_bytes = 0.0;   ///< resident before the scene was built, when a small crush has been done
  double build_bytes = 0.0;  ///< the most that was resident until the run began, beyond base_bytes
  double peak_bytes = 0.0;   ///< the same until the run's end
  double scene_bytes = 0.0;  ///< of the scene's arrays
  double state_bytes = 0.0;  ///< of the state's arrays at the end
};

template <class Arrays>
double array_bytes(const Arrays& arrays) {
  double bytes = 0.0;
  visit_arrays(arrays,
               [&bytes](const auto& array) { bytes += static_cast<double>(array.capacity() * sizeof(array[0])); });
  return bytes;
}

/// What the program itself takes, text above all, is in memory when a few cells have been crushed in the same way.
void warm_up(SceneSpec spec) {
  auto& hexagon = scenes::cells_of(spec);
  hexagon.columns = 6;
  hexagon.rows = 4;
  Simulation simulation(scenes::build(spec));
  scenes::watch(
      simulation, [](const Sample&) {}, 100);
  simulation.take_frame(0);
}

/// Samples and frames are taken as the case asks; a frame is dropped, as a worker does that has sent it.
CrushCost crush(const SceneSpec& spec, const std::string& target) {
  use_simd_target(target);
  warm_up(spec);
  CrushCost cost;
  cost.base_bytes = resident_bytes();
  const double begin = processor_seconds();
  const auto scene = scenes::build(spec);
  const SceneFacts facts = facts_of(*scene);
  const double start = processor_seconds();
  cost.build_seconds = start - begin;
  cost.build_bytes = greatest_resident_bytes() - cost.base_bytes;
  Simulation simulation(scene);
  worker::use_large_pages(simulation);
  worker::StageTimer timer;
  std::vector<Sample> samples;
  int frames = 0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(facts.sample_interval, &timer);
    samples.push_back(simulation.take_sample());
    if (simulation.step() >= frames * facts.frame_interval) simulation.take_frame(frames++);
  }
  cost.seconds = processor_seconds() - start;
  cost.elements = static_cast<double>(facts.element_count);
  cost.steps = static_cast<double>(simulation.step());
  cost.strain = samples.back().strain;
  cost.stage_seconds = timer.seconds();
  cost.peak_bytes = greatest_resident_bytes() - cost.base_bytes;
  cost.scene_bytes = array_bytes(*scene);
  cost.state_bytes = array_bytes(simulation.state());
  return cost;
}

/// Crushes in a process of its own, so that its memory is nothing else's, by a kernel. Throws
/// std::runtime_error when the crush did not reach its end. REQUIRES: a spec that says its end strain.
CrushCost crush_apart(const SceneSpec& spec, const std::string& target) {
  const auto cost = measure_apart([&] { return crush(spec, target); });
  if (!cost || cost->strain < *spec.loading.end_strain - 0.001) {
    throw std::runtime_error("the crush did not reach its end.");
  }
  return *cost;
}

using client::Chart;
using client::Curve;
using client::Marker;

constexpr double kWidth = 820.0;
constexpr double kHeight = 330.0;
constexpr double kMargin = 12.0;
constexpr double kMostTimesTheTime = 1.5;
constexpr double kMostBytes = 600.0;
const client::LineStyle kBound{client::kMutedInk, 1.2, {6.0, 4.0}};

Curve curve_of(const std::vector<Measured>& measured, const std::vector<std::pair<const char*, double>>& terms,
               std::string name, int colour) {
  Curve curve{{}, {}, {client::kSeriesColours[colour], 1.6, {}}, std::move(name), Marker::disc};
  for (const Measured& row : measured) {
    double sum = 0.0;
    for (const auto& [counter, factor] : terms) sum += factor * row.counters.at(counter);
    curve.x.push_back(row.counters.at("elements"));
    curve.y.push_back(sum);
  }
  return curve;
}

Chart build_chart(std::vector<Curve> curves, const std::string& label) {
  Chart chart;
  chart.x = {0.7 * curves.front().x.front(), 1.5 * curves.front().x.back(), "elements", true};
  chart.y.label = label;
  chart.curves = std::move(curves);
  return chart;
}

void leave_room(Chart& chart) {
  for (const Curve& curve : chart.curves) {
    chart.y.high = std::max(chart.y.high, 1.12 * *std::max_element(curve.y.begin(), curve.y.end()));
  }
}

Chart time_chart(const std::vector<Measured>& measured) {
  Chart chart = build_chart(
      {curve_of(measured, {{"element_step_ns", 1.0}}, "all in", 0),
       curve_of(measured, {{"integrate_motion_ns", 1.0}, {"evaluate_internal_forces_ns", 1.0}}, "walls and motion", 1),
       curve_of(measured, {{"find_contacts_ns", 1.0}, {"evaluate_contact_forces_ns", 1.0}}, "contacts", 2)},
      "time an element-step (ns)");
  chart.curves.push_back(client::level_curve(kMostTimesTheTime * chart.curves.front().y.front(), chart.x.low,
                                             chart.x.high, kBound, "1.5 times the smallest"));
  leave_room(chart);
  return chart;
}

Chart memory_chart(const std::vector<Measured>& measured) {
  Chart chart = build_chart(
      {curve_of(measured, {{"bytes_an_element", 1.0}}, "most resident", 0),
       curve_of(measured, {{"scene_array_bytes_an_element", 1.0}, {"state_array_bytes_an_element", 1.0}}, "arrays", 3)},
      "memory (bytes an element)");
  chart.curves.push_back(client::level_curve(kMostBytes, chart.x.low, chart.x.high, kBound, "600 bytes"));
  leave_room(chart);
  return chart;
}

/// Draws how time and memory grow with the lattice, from the benchmarks named cells/..., to a file .svg or .png. Throws
/// std::invalid_argument on another name or fewer than two such benchmarks, std::runtime_error when it cannot be
/// written.
void draw_growth(const std::string& file, const std::vector<Measured>& measured) {
  std::vector<Measured> cells;
  std::copy_if(measured.begin(), measured.end(), std::back_inserter(cells),
               [](const Measured& row) { return row.benchmark.starts_with("cells/"); });
  if (cells.size() < 2) {
    throw std::invalid_argument("--chart=" + file +
                                ": takes two benchmarks named cells/... at least; let the filter pass them.");
  }
  write_picture(file, kWidth, kHeight, [&](cairo_t* context) {
    const double half = 0.5 * (kWidth - 3.0 * kMargin);
    client::draw_chart(context, {kMargin, kMargin, half, kHeight - kMargin}, time_chart(cells));
    client::draw_chart(context, {2.0 * kMargin + half, kMargin, half, kHeight - kMargin}, memory_chart(cells));
  });
}

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

SceneSpec to_strain(SceneSpec spec, double strain) {
  // Samples and frames as far apart as those of the whole crush.
  const double share = strain / LoadingSpec::kDefaultEndStrain;
  spec.output.sample_count = static_cast<int>(share * spec.output.sample_count);
  spec.output.frame_count = static_cast<int>(share * spec.output.frame_count);
  spec.loading.end_strain = strain;
  return spec;
}

void add_all(const Flags&) {
  for (const std::string& target : simd_targets()) {
    add("whole/type-i-paper/" + target, to_strain(scenes::papers_type_i(), LoadingSpec::kDefaultEndStrain), target);
  }
  for (int times = 1; times <= kMostTimes; times *= 4) {
    add("cells/" + std::to_string(times), to_strain(scenes::papers_type_i_wider(times), kGrowthStrain),
        simd_targets().front(), std::max(1, kCellsTimed / times));
  }
}

}  // namespace
}  // namespace cellcrush::bench

int main(int count, char** words) {
  using namespace cellcrush::bench;
  return run_benchmarks(count, words, add_all, draw_growth);
}
