#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "scenes/frames.h"

namespace cellcrush::stability {

/// A run to its end, or to what ended it.
struct WatchedRun {
  std::shared_ptr<Scene> scene;
  RunStatus status;
  std::vector<Sample> samples;  ///< that passed the check
  double lost_strain = 0.0;     ///< of the one that did not
  Summary summary;
  FieldFrame last_good;
  std::int64_t step = 0;

  explicit WatchedRun(std::shared_ptr<Scene> built) : scene(std::move(built)) {
    Simulation simulation(scene);
    scenes::watch(simulation, [&](const Sample& sample) {
      const RunStatus::Kind kind = simulation.status().kind;
      if (kind == RunStatus::Kind::running || kind == RunStatus::Kind::finished) {
        samples.push_back(sample);
      } else {
        lost_strain = sample.strain;
      }
    });
    status = simulation.status();
    summary = summarize(*scene, samples);
    last_good = simulation.last_good_frame();
    step = simulation.step();
    simulation.advance(10);
    EXPECT_EQ(simulation.step(), step) << "a run that has ended goes on";
  }
  explicit WatchedRun(const SceneSpec& spec) : WatchedRun(scenes::build(spec)) {}

  /// Null if there was none.
  [[nodiscard]] const Warning* warning_of(Warning::Kind kind) const {
    const auto found = std::ranges::find(summary.warnings, kind, &Warning::kind);
    return found == summary.warnings.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool warns_of(Warning::Kind kind) const { return warning_of(kind) != nullptr; }
};

}  // namespace cellcrush::stability
