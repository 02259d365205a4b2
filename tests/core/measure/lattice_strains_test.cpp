// Lateral strain, Poisson's ratio, local strain and absorption efficiency, against deformations and curves that are
// known, and the regular hexagon's closed form.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "measure/lateral_strain.h"
#include "measure/local_strain.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush::lattice_strains {
namespace {

constexpr double kSide = 4.0;

std::shared_ptr<Scene> lattice(const char* kind, LoadingSpec::Direction direction, int elements = 2) {
  SceneSpec spec = scenes::preset("hexagon-small");
  spec.lattice = RegularLattice{kind, 8, 6, kSide, 0.2, {}};
  spec.elements_per_wall = elements;
  spec.loading.direction = direction;
  return scenes::build(spec);
}

std::vector<Vector2> mapped(const Scene& scene, const Eigen::Matrix2d& map) {
  std::vector<Vector2> out;
  for (const Vector2& place : scene.position) out.emplace_back(map * place);
  return out;
}

// Of one map for all joints, every cell has the strain of the map along the crush, whatever it turns.
TEST(LocalStrain, OfAMapIsThatOfALineAlongTheCrush) {
  const Eigen::Matrix2d turn = Eigen::Rotation2D<double>(0.7).toRotationMatrix();
  Eigen::Matrix2d map;
  map << 0.6, 0.1, 0.05, 1.2;
  for (const char* kind : {"hexagon", "square", "triangle"}) {
    for (const auto direction : {LoadingSpec::Direction::x, LoadingSpec::Direction::y}) {
      const auto scene = lattice(kind, direction);
      const LocalStrain local(*scene, trace_faces(scene->position, scene->elements));
      const int axis = scene->plates.axis;
      std::vector<float> strains;
      for (const auto& [of, expected] : {std::pair(map, 1.0 - map.col(axis).norm()), std::pair(turn, 0.0),
                                         std::pair(Eigen::Matrix2d(turn * map), 1.0 - map.col(axis).norm())}) {
        local.evaluate(mapped(*scene, of), strains);
        ASSERT_EQ(strains.size(), scene->wall_count());
        for (const float strain : strains) EXPECT_NEAR(strain, expected, 1e-6) << kind << axis;
      }
    }
  }
}

// Rows of squares, one of them crushed to half: walls between two rows have the mean of both.
TEST(LocalStrain, OfOneCrushedRowIsNothingBesideIt) {
  const auto scene = lattice("square", LoadingSpec::Direction::y);
  const LocalStrain local(*scene, trace_faces(scene->position, scene->elements));
  std::vector<Vector2> position = scene->position;
  for (Vector2& place : position) place.y() -= 0.5 * std::clamp(place.y() - 2.0 * kSide, 0.0, kSide);
  std::vector<float> strains;
  local.evaluate(position, strains);
  for (std::size_t wall = 0; wall < scene->walls.start.size(); ++wall) {
    const Vector2 middle =
        0.5 * (scene->position[scene->walls.start[wall]] + scene->position[scene->walls.end[wall]]) / kSide;
    const double from = std::abs(middle.y() - 2.5);
    const double expected = from < 0.25 ? 0.5 : from < 0.75 ? 0.25 : 0.0;
    EXPECT_NEAR(strains[scene->list_order.listed_wall(static_cast<int>(wall))], expected, 1e-6)
        << middle.x() << " " << middle.y();
  }
}

TEST(LateralStrain, OfAMapIsThatOfALineAcross) {
  Eigen::Matrix2d map;
  map << 0.7, 0.0, 0.0, 1.25;
  for (const char* kind : {"hexagon", "square", "triangle"}) {
    for (const auto direction : {LoadingSpec::Direction::x, LoadingSpec::Direction::y}) {
      const auto scene = lattice(kind, direction);
      State state = make_initial_state(*scene);
      std::ranges::copy(mapped(*scene, map), state.position.begin());
      const SidePairs pairs = find_side_pairs(*scene, kSide);
      ASSERT_GE(pairs.low.size(), 3u);
      const int across = 1 - scene->plates.axis;
      EXPECT_NEAR(lateral_strain_of(pairs, *scene, state), map(across, across) - 1.0, 1e-12) << kind << across;
    }
  }
}

// What happens near the plates does not count.
TEST(LateralStrain, IsThatOfTheMiddleHalf) {
  const auto scene = lattice("square", LoadingSpec::Direction::x);
  State state = make_initial_state(*scene);
  for (Vector2& place : state.position) {
    if (std::abs(place.x() / (8 * kSide) - 0.5) > 0.26) place.y() *= 3.0;
  }
  EXPECT_EQ(lateral_strain_of(find_side_pairs(*scene, kSide), *scene, state), 0.0);
}

// Regular hexagons along x, whose walls also shorten: (1 - m) / (1 + 3 m) with m = (h/L)^2.
TEST(PoissonsRatio, OfElasticHexagonsIsTheClosedForm) {
  SceneSpec spec = scenes::preset("hexagon-small");
  spec.lattice = RegularLattice{"hexagon", 24, 18, kSide, 0.1 * kSide, {}};
  spec.imperfection = {};
  spec.loading.speed_m_per_s = 1.0;
  spec.loading.end_strain = 0.005;
  spec.loading.ramp_strain = 0.002;
  spec.material.yield_stress_mpa = 1e6;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const double found = summarize(*scene, scenes::run_to_end(simulation)).poissons_ratio.value();
  scenes::record_bound("relative error", std::abs(found / (0.99 / 1.03) - 1.0), 0.01);
}

// The efficiency of a run, from its samples alone.
TEST(AbsorptionEfficiency, OfARunIsTheIntegralOverTheStressOfTheLastPercent) {
  SceneSpec spec = scenes::spec_of({"hexagon", 100.0, 0.0}, 8, 6);
  spec.loading.end_strain = 0.2;
  spec.output.sample_count = 130;
  Simulation simulation(scenes::build(spec));
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  std::vector<double> strain = {0.0};
  std::vector<double> energy = {0.0};
  for (const Sample& sample : samples) {
    energy.push_back(energy.back() +
                     0.5 * (sample.stress_impact + sample.stress_support) * (sample.strain - strain.back()));
    strain.push_back(sample.strain);
    const double begin = std::max(0.0, sample.strain - 0.01);
    std::size_t k = 1;
    while (strain[k] < begin) ++k;
    const double before =
        energy[k - 1] + (energy[k] - energy[k - 1]) * (begin - strain[k - 1]) / (strain[k] - strain[k - 1]);
    const double expected = energy.back() * (sample.strain - begin) / (energy.back() - before);
    EXPECT_NEAR(sample.absorption_efficiency, expected, 1e-9 * expected) << sample.strain;
  }
}

}  // namespace
}  // namespace cellcrush::lattice_strains
