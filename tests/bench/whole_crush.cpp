#include "bench/whole_crush.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <variant>
#include <vector>

#include "bench/machine.h"
#include "cellcrush/scene.h"
#include "cellcrush/simd.h"
#include "cellcrush/state.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "worker/large_pages.h"
#include "worker/stage_timer.h"

namespace cellcrush::bench {
namespace {

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
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(100);
    simulation.take_sample();
  }
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

}  // namespace

CrushCost crush_apart(const SceneSpec& spec, const std::string& target) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a process of its own.");
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const CrushCost cost = crush(spec, target);
    _exit(write(ends[1], &cost, sizeof(cost)) == sizeof(cost) ? 0 : 1);
  }
  close(ends[1]);
  CrushCost cost;
  const bool told = child > 0 && read(ends[0], &cost, sizeof(cost)) == sizeof(cost);
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  if (!told || cost.strain < spec.loading.end_strain - 0.001) {
    throw std::runtime_error("the crush did not reach its end.");
  }
  return cost;
}

}  // namespace cellcrush::bench
