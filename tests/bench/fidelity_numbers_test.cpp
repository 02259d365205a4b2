#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "bench/precision.h"
#include "cellcrush/fidelity.h"
#include "validation/options.h"

namespace cellcrush::bench {
namespace {

const std::string kFolder = CELLCRUSH_BENCH_FOLDER;

/// The column of each scene's error.
const std::map<std::string, std::string> kColumns = {{"type-i", "plateau_stress_support"},
                                                     {"example-1", "limit_stress"}};

/// What a fidelity fills in, and what it was measured with.
auto settings_of(const SceneSpec& spec) {
  return std::tuple(*spec.elements_per_wall, spec.section.axial_count(), spec.section.depth_count(),
                    spec.section.formulation, spec.section.depth_rule, spec.section.area_rule,
                    spec.numerics.time_step_s, spec.numerics.mass_scaling, spec.numerics.rotary_scaling,
                    spec.numerics.fibre_precision, spec.contact.stiffness_factor, spec.contact.search);
}

/// The variant of a scene that a fidelity is.
const Variant* find_variant(const VariedScene& scene, const FidelityPoint& point) {
  SceneSpec plain = validation::read_options(scene.words).spec;
  plain.section = {};
  plain.numerics.fidelity = point.fidelity;
  for (const Variant& variant : scene.variants) {
    const SceneSpec varied = fill_in_fidelity(validation::read_options(words_of(scene, variant, 1)).spec);
    if (settings_of(varied) == settings_of(fill_in_fidelity(plain))) return &variant;
  }
  return nullptr;
}

double time_of_element_step(const VariedScene& scene, const Variant& variant, const std::vector<CsvRow>& rows) {
  double seconds = 0.0;
  double element_steps = 0.0;
  for (const CsvRow& row : rows) {
    if (!is_of(row, scene, variant)) continue;
    seconds += number_in(row, "processor_seconds");
    element_steps += number_in(row, "elements") * number_in(row, "steps");
  }
  return seconds / element_steps;
}

class FidelityNumbers : public ::testing::Test {
 protected:
  std::vector<VariedScene> scenes_ = read_variants(kFolder + "/work_precision.txt");
  std::vector<CsvRow> rows_ = read_csv(kFolder + "/results/work_precision.csv");
};

TEST_F(FidelityNumbers, AreThoseOfTheTable) {
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    double scatter = 0.0;
    const auto all = precisions(scenes_[i], rows_, {kColumns.at(scenes_[i].name), ""}, kConverged, scatter);
    for (const FidelityPoint& point : fidelity_points()) {
      const Variant* variant = find_variant(scenes_[i], point);
      ASSERT_NE(variant, nullptr) << point.name;
      const auto found = std::find_if(all.begin(), all.end(),
                                      [&](const Precision& precision) { return precision.variant == variant->name; });
      ASSERT_NE(found, all.end()) << point.name;
      ASSERT_EQ(point.errors.size(), scenes_.size());
      EXPECT_NEAR(point.errors[i].error, found->error, 0.0005) << point.name << " " << scenes_[i].name;
      EXPECT_NEAR(point.errors[i].uncertainty, found->uncertainty, 0.0005) << point.name << " " << scenes_[i].name;
      EXPECT_NEAR(point.errors[i].scatter, found->scatter, 0.0005) << point.name << " " << scenes_[i].name;
      EXPECT_GE(found->seeds, 3) << point.name;
    }
  }
}

TEST_F(FidelityNumbers, TimesOfElementStepsAreThoseOfTheTable) {
  const VariedScene& scene = scenes_.front();
  const auto& points = fidelity_points();
  const double standard = time_of_element_step(scene, *find_variant(scene, points[1]), rows_);
  for (const FidelityPoint& point : points) {
    EXPECT_NEAR(point.step_cost, time_of_element_step(scene, *find_variant(scene, point), rows_) / standard, 0.005)
        << point.name;
  }
}

// So far as seeds can tell.
TEST_F(FidelityNumbers, DearerIsNoLessAccurate) {
  const auto& points = fidelity_points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (std::size_t k = 0; k < points[i].errors.size(); ++k) {
      EXPECT_LT(points[i].errors[k].claimed(), points[i - 1].errors[k].claimed())
          << points[i].name << " " << points[i].errors[k].measure;
    }
  }
}

}  // namespace
}  // namespace cellcrush::bench
