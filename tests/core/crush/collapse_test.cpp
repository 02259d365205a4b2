#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "measure/crush_mode.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

struct Crush {
  std::shared_ptr<Scene> scene;
  std::vector<Sample> samples;
  std::vector<FieldFrame> frames;
  Summary summary;
};

/// 17 rows of 24 and 23 hexagons of Type I, imperfect by a thousandth of a millimetre: a perfectly symmetric specimen
/// stays symmetric by round-off only. A frame with every sample.
Crush crush_specimen(double speed, double end_strain) {
  SceneSpec spec = scenes::hexagon_specimen(24, 17);
  spec.loading.speed_m_per_s = speed;
  spec.loading.end_strain = end_strain;
  spec.output.sample_count = 100;
  spec.imperfection = {0.001, 4};
  Crush crush;
  crush.scene = scenes::build(spec);
  Simulation simulation(crush.scene);
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(facts_of(*crush.scene).sample_interval);
    crush.samples.push_back(simulation.take_sample());
    crush.frames.push_back(simulation.take_frame(static_cast<int>(crush.frames.size())));
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  crush.summary = summarize(*crush.scene, crush.samples);
  return crush;
}

/// Mean distance of the collapsed cells from the impact end, over the length.
double mean_place(const CollapseField& field) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t cell = 0; cell < field.collapsed.size(); ++cell) {
    sum += field.collapsed[cell] ? field.along[cell] : 0.0;
    count += field.collapsed[cell] ? 1.0 : 0.0;
  }
  return sum / (count * field.length);
}

std::vector<Vector2> positions_of(const FieldFrame& frame) {
  std::vector<Vector2> position;
  for (std::size_t i = 0; i < frame.position.size(); i += 2) {
    position.emplace_back(frame.position[i], frame.position[i + 1]);
  }
  return position;
}

TEST(Collapse, AFastCrushIsAnIBandAtTheImpactEndWithAFront) {
  const Crush crush = crush_specimen(100.0, 0.42);
  EXPECT_EQ(crush.summary.crush_mode, CrushMode::i);
  ASSERT_TRUE(crush.summary.crush_mode_strain);
  EXPECT_LT(*crush.summary.crush_mode_strain, 0.2);
  ASSERT_TRUE(crush.summary.front);
  EXPECT_GT(crush.summary.front->strain_behind, 0.85);
  EXPECT_LT(crush.summary.front->strain_behind, 0.95);
  EXPECT_NEAR(crush.summary.front->velocity_behind, 1e5, 2e3);
}

TEST(Collapse, KeptFramesSayTheSameAsTheRun) {
  const Crush crush = crush_specimen(100.0, 0.25);
  const Cells cells = find_cells(*crush.scene);
  int told = 0;
  for (std::size_t i = 0; i < crush.frames.size(); ++i) {
    const CollapseField field = find_collapse(cells, positions_of(crush.frames[i]));
    EXPECT_NEAR(collapsed_fraction_of(field), crush.samples[i].collapsed_fraction, 0.003) << i;
    if (crush.samples[i].crush_mode != CrushMode::none) {
      ++told;
      EXPECT_EQ(find_crush_mode(field), crush.samples[i].crush_mode) << i;
      EXPECT_LT(mean_place(field), 0.2) << i;
    }
  }
  EXPECT_GE(told, 3);
}

TEST(Collapse, ASlowCrushIsAVWithItsPointAtTheImpactPlateAndHasNoFront) {
  const Crush crush = crush_specimen(10.0, 0.4);
  EXPECT_EQ(crush.summary.crush_mode, CrushMode::v);
  EXPECT_FALSE(crush.summary.front);
  // The V lies at the middle of the plate and opens to both sides: cells of the middle rows collapse nearer to it.
  const Cells cells = find_cells(*crush.scene);
  for (std::size_t i = 0; i < crush.samples.size(); ++i) {
    if (crush.samples[i].crush_mode != CrushMode::v) {
      continue;
    }
    const CollapseField field = find_collapse(cells, positions_of(crush.frames[i]));
    double farthest_middle = 0.0;
    double farthest_side = 0.0;
    for (std::size_t cell = 0; cell < field.collapsed.size(); ++cell) {
      const double off = std::abs(field.across[cell] / field.width - 0.5);
      double& farthest = off < 0.1 ? farthest_middle : farthest_side;
      if (field.collapsed[cell] && (off < 0.1 || off > 0.35)) {
        farthest = std::max(farthest, field.along[cell]);
      }
    }
    EXPECT_GT(farthest_side, farthest_middle + cells.field.pitch) << "sample " << i;
  }
}

}  // namespace
}  // namespace cellcrush
