// Predicted memory of runs against what becomes resident, from before the scene is built until the crush ends.
#include "cellcrush/run_memory.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "bench/machine.h"
#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

constexpr double kTolerance = 0.15;

using bench::resident_bytes;

/// Bytes that a run takes, or is predicted to take.
struct Memory {
  double resident = 0.0;
  double checkpoint = 0.0;  ///< at the end
};

/// The most that is resident while a simulation is crushed, samples and frames taken; none if it does not come to its
/// end.
Memory crush(const SceneSpec& spec) {
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  Memory most{resident_bytes()};
  scenes::watch(simulation, [&](const Sample&) {
    if (simulation.step() % facts_of(*scene).frame_interval == 0) simulation.take_frame(0);
    most.resident = std::max(most.resident, resident_bytes());
  });
  simulation.checkpoint([&most](std::string_view piece) { most.checkpoint += static_cast<double>(piece.size()); });
  return simulation.status().kind == RunStatus::Kind::finished ? most : Memory();
}

/// What a crush makes resident beyond a small one of the same kind, which brings the code into memory.
Memory measure(const SceneSpec& small, const SceneSpec& spec) {
  malloc_trim(0);  // what the specs took
  crush(small);
  const double before = resident_bytes();
  Memory memory = crush(spec);
  memory.resident -= before;
  return memory;
}

/// A lattice that is crushed fast.
struct Crush {
  const char* name;
  const char* preset;
  int columns;  ///< along the crush: the fewer, the fewer steps
  int rows;
  double end_strain = 0.8;
  std::function<void(SceneSpec&)> change = [](SceneSpec&) {};

  friend void PrintTo(const Crush& crush, std::ostream* out) { *out << crush.name; }
};

/// The walls as a frame without plates. What acts on it does so in as long as the crush between plates would last.
SceneSpec without_plates(const SceneSpec& crush, const Scene& scene) {
  SceneSpec spec = scenes::listed(crush);
  spec.loading.speed_m_per_s.reset();
  spec.loading.end_strain.reset();
  spec.loading.end_time_s = *crush.loading.end_strain * scene.length / scene.plates.speed;
  return spec;
}

/// Half planes instead of the plates; the first moves as they do.
void between_rigid_walls(SceneSpec& spec) {
  const auto scene = scenes::build(spec);
  const double travel = *spec.loading.end_strain * scene->length;
  spec = without_plates(spec, *scene);
  spec.loads.rigid_walls = {
      {scene->plates.impact_face, 0.0, 1.0, 0.0, 0.0, {{0.0, 0.0}, {*spec.loading.end_time_s, travel}}},
      {scene->plates.support_face, 0.0, -1.0, 0.0}};
}

/// The first has a mass, a little more than that of the lattice.
void struck(SceneSpec& spec) {
  const auto scene = scenes::build(spec);
  const double mass_g = 1.2 * scene->total_mass / kTonnePerGram;
  const double speed = *spec.loading.speed_m_per_s;
  spec = without_plates(spec, *scene);
  spec.loads.rigid_walls = {{scene->plates.impact_face, 0.0, 1.0, 0.0}, {scene->plates.support_face, 0.0, -1.0, 0.0}};
  spec.loads.rigid_walls[0].own = {{"mass_g", mass_g}, {"speed_m_per_s", speed}};
}

/// Forces on the nodes of one side push against the other, which is held, for `times` as long.
void pressed(SceneSpec& spec, double force, double times) {
  const auto scene = scenes::build(spec);
  spec = without_plates(spec, *scene);
  spec.loading.end_time_s = times * *spec.loading.end_time_s;
  auto& frame = std::get<FrameWalls>(spec.lattice);
  constexpr double kSide = 5.0;  // mm: a row of cells
  for (int i = 0; i < static_cast<int>(frame.nodes.size()); ++i) {
    const double x = frame.nodes[i].x_mm;
    if (x > scene->plates.support_face - kSide) frame.supports.push_back({i, true, true, true});
    if (x < scene->plates.impact_face + kSide) {
      spec.loads.loads.push_back({i, LoadsSpec::Component::x, {{0.0, force}}});
    }
  }
}

void with_papers_rule(SceneSpec& spec) { spec = scenes::with_the_papers_elements(spec); }

SceneSpec spec_of(const Crush& crush, int columns, int rows) {
  SceneSpec spec = scenes::preset(crush.preset);
  scenes::cells_of(spec).columns = columns;
  scenes::cells_of(spec).rows = rows;
  spec.loading.speed_m_per_s = 300.0;
  spec.loading.end_strain = crush.end_strain;
  spec.output.sample_count = 100;
  spec.output.frame_count = 5;
  crush.change(spec);
  return spec;
}

class RunMemory : public testing::TestWithParam<Crush> {};

TEST_P(RunMemory, AndCheckpointAreWithin15Percent) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "Sanitizers take memory of their own.";
#endif
  const Crush& crush = GetParam();
  const auto measured = bench::measure_apart(
      [&crush] { return measure(spec_of(crush, 6, 4), spec_of(crush, crush.columns, crush.rows)); });
  ASSERT_TRUE(measured && measured->checkpoint > 0.0) << "the crush did not reach its end";
  const SceneSpec spec = spec_of(crush, crush.columns, crush.rows);
  const auto scene = scenes::build(spec);
  const Memory predicted = {static_cast<double>(memory_of_run(spec, *scene)),
                            static_cast<double>(checkpoint_of_run(spec, *scene))};
  const auto expect_near = [&](const char* what, double expected, double found) {
    const auto elements = static_cast<double>(scene->element_count());
    std::printf("%.0f elements: %s %.0f, predicted %.0f bytes an element, ratio %.3f\n", elements, what,
                found / elements, expected / elements, expected / found);
    EXPECT_NEAR(expected, found, kTolerance * found) << what;
  };
  expect_near("resident", predicted.resident, measured->resident);
  expect_near("checkpoint", predicted.checkpoint, measured->checkpoint);
}

const Crush kCrushes[] = {
    {"hexagons", "type-i", 20, 60},
    {"hexagons_to_half", "type-i", 30, 80, 0.5},
    {"hexagons_hardening_double", "type-i", 30, 60, 0.8,
     [](SceneSpec& spec) {
       spec.material.hardening_modulus_mpa = 700.0;
       spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
     }},
    {"hexagons_friction", "type-i", 30, 60, 0.8,
     [](SceneSpec& spec) { spec.contact.friction = spec.plates.friction = 0.2; }},
    {"hexagons_buckets", "type-i", 30, 60, 0.8,
     [](SceneSpec& spec) { spec.contact.search = ContactSpec::Search::buckets; }},
    {"hexagons_in_bands_papers_rule", "type-i", 12, 720, 0.8, with_papers_rule},
    {"squares", "type-ii-as-counted", 15, 80, 0.8, [](SceneSpec& spec) { spec.elements_per_wall = 2; }},
    {"triangles_papers_rule", "type-iii-as-counted", 30, 50, 0.8, with_papers_rule},
    {"frame_between_rigid_walls", "type-i", 30, 60, 0.4, between_rigid_walls},
    {"frame_struck", "type-i", 30, 60, 0.8, struck},
    {"frame_bearing_loads", "type-i", 30, 60, 0.4, [](SceneSpec& spec) { pressed(spec, 1.0, 1.0); }},
    {"frame_yielding_to_loads", "type-i", 30, 60, 0.8, [](SceneSpec& spec) { pressed(spec, 10.0, 8.0); }},
};

INSTANTIATE_TEST_SUITE_P(Crushes, RunMemory, testing::ValuesIn(kCrushes),
                         [](const auto& test) { return std::string(test.param.name); });

// Loading so slow that single precision would round it away: the specimen of the prediction must not be crushed faster.
TEST(PredictedMemory, OfASlowCrushIsThatOfDoublePrecision) {
  SceneSpec spec = scenes::preset("type-i");
  const auto predicted_at = [&spec](double speed) {
    spec.loading.speed_m_per_s = speed;
    return memory_of_run(spec, *scenes::build(spec));
  };
  const std::int64_t slow = predicted_at(0.1);
  EXPECT_GT(slow, predicted_at(1.0));
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  EXPECT_EQ(slow, predicted_at(0.1));
}

/// Type I, wider: minutes.
const Crush kLargeCrushes[] = {
    {"type_i", "type-i", 74, 21},
    {"type_i_papers_rule", "type-i", 74, 21, 0.8, with_papers_rule},
    {"type_i_4", "type-i", 74, 84},
    {"type_i_4_papers_rule", "type-i", 74, 84, 0.8, with_papers_rule},
    {"type_i_16", "type-i", 74, 336},
    {"type_i_16_papers_rule", "type-i", 74, 336, 0.8, with_papers_rule},
    {"type_i_64_papers_rule_to_a_fifth", "type-i", 74, 1344, 0.2, with_papers_rule},
    {"squares_8_to_half", "type-ii-as-counted", 73, 144, 0.5},
    {"triangles_4", "type-iii-as-counted", 74, 84},
};

INSTANTIATE_TEST_SUITE_P(Large, RunMemory, testing::ValuesIn(kLargeCrushes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace cellcrush
