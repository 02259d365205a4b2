// Predicted memory of runs against what becomes resident, from before the scene is built until the crush ends.
#include "cellcrush/run_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <variant>

#include "bench/machine.h"
#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

constexpr double kTolerance = 0.15;

using bench::resident_bytes;

/// The most that is resident while a simulation is crushed, samples and frames taken.
double crush(const SceneSpec& spec) {
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  double most = resident_bytes();
  scenes::watch(simulation, [&](const Sample&) {
    if (simulation.step() % facts_of(*scene).frame_interval == 0) simulation.take_frame(0);
    most = std::max(most, resident_bytes());
  });
  return simulation.status().kind == RunStatus::Kind::finished ? most : 0.0;
}

void set_size(SceneSpec& spec, int columns, int rows) {
  if (auto* lattice = std::get_if<RegularLattice>(&spec.lattice)) {
    lattice->columns = columns;
    lattice->rows = rows;
  }
}

struct Memory {
  double elements = 0.0;
  double resident = 0.0;   ///< bytes; below 0: the crush did not reach its end
  double predicted = 0.0;  ///< bytes
};

/// What a crush makes resident beyond a small one of the same kind, which brings the code into memory.
Memory measure(const SceneSpec& spec) {
  SceneSpec small = spec;
  set_size(small, 6, 4);
  crush(small);
  const double before = resident_bytes();
  Memory memory;
  memory.resident = crush(spec) - before;
  const auto scene = scenes::build(spec);
  memory.predicted = static_cast<double>(memory_of_run(spec, *scene));
  memory.elements = static_cast<double>(scene->element_count());
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

void with_papers_rule(SceneSpec& spec) { spec = scenes::with_the_papers_elements(spec); }

SceneSpec spec_of(const Crush& crush) {
  SceneSpec spec = scenes::preset(crush.preset);
  set_size(spec, crush.columns, crush.rows);
  crush.change(spec);
  spec.loading.speed_m_per_s = 300.0;
  spec.loading.end_strain = crush.end_strain;
  spec.output.sample_count = 100;
  spec.output.frame_count = 5;
  return spec;
}

class RunMemory : public testing::TestWithParam<Crush> {};

TEST_P(RunMemory, IsResidentWithin15Percent) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "Sanitizers take memory of their own.";
#endif
  const Memory memory = bench::measure_apart([] { return measure(spec_of(GetParam())); }).value_or(Memory());
  ASSERT_GT(memory.resident, 0.0) << "the crush did not reach its end";
  std::printf("%.0f elements: resident %.0f, predicted %.0f bytes an element, ratio %.3f\n", memory.elements,
              memory.resident / memory.elements, memory.predicted / memory.elements,
              memory.predicted / memory.resident);
  EXPECT_NEAR(memory.predicted, memory.resident, kTolerance * memory.resident);
}

const Crush kCrushes[] = {
    {"hexagons", "type-i", 40, 60},
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
    {"squares", "type-ii-as-counted", 30, 80, 0.8, [](SceneSpec& spec) { spec.elements_per_wall = 2; }},
    {"triangles_papers_rule", "type-iii-as-counted", 30, 50, 0.8, with_papers_rule},
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
