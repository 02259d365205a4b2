#include "scenes/run_frame.h"

#include <gtest/gtest.h>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"

namespace cellcrush::scenes {

std::vector<Sample> run_frame(const SceneSpec& spec) {
  const auto scene = build(spec);
  std::vector<Sample> samples;
  if (scene == nullptr) {
    return samples;
  }
  Simulation simulation(scene);
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(scene->schedule.sample_interval);
    samples.push_back(simulation.take_sample());
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return samples;
}

}  // namespace cellcrush::scenes
