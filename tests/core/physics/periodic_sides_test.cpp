// Sides that repeat (E9i): the elastic moduli of the closed forms in a strip two cells wide, nothing that depends on
// where the lattice is cut, contacts across the sides, ledger, bits. Blind to: the law of contact, which is that of any
// walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "lattice/lattice.h"
#include "measure/theory.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"

namespace cellcrush::periodic {
namespace {

using Direction = LoadingSpec::Direction;
using Sides = LoadingSpec::Sides;

constexpr double kModulus = 70000.0;  // MPa
constexpr double kSide = 10.0;

struct OneLattice {
  std::string name;
  std::string kind;
  double ratio;  ///< of thickness and side
  std::map<std::string, double> own;
  int cells = 6;  ///< of the shorter strip; more where its ends hold its width

  [[nodiscard]] RegularLattice of(int columns, int rows) const {
    return {kind, columns, rows, kSide, ratio * kSide, own};
  }
  friend void PrintTo(const OneLattice& one, std::ostream* out) { *out << one.name; }
};

/// A strip two cells wide, the fewest that a lattice can have, and `cells` long.
SceneSpec elastic_strip(const OneLattice& one, Direction direction, int cells, int across = 2) {
  const bool along_x = direction == Direction::x;
  SceneSpec spec;
  spec.lattice = along_x ? one.of(cells, across) : one.of(across, cells);
  spec.depth_mm = 1.0;
  spec.elements_per_wall = one.kind == "sinusoidal_square" ? 8 : one.kind == "anti_tetrachiral" ? 4 : 1;
  spec.material.youngs_modulus_mpa = kModulus;
  spec.material.yield_stress_mpa = 1e6;
  spec.material.density_kg_per_m3 = scenes::kDensity;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.loading.direction = direction;
  spec.loading.sides.kind = Sides::Kind::periodic;
  spec.output.sample_count = 40;
  return spec;
}

struct Slopes {
  double length;      ///< mm
  double compliance;  ///< mm of travel for each MPa
  double widening;    ///< lateral strain for each MPa
};

/// Presses a strip slowly, damped about critically. Slopes are those of the second half of the run.
Slopes press(SceneSpec spec, double modulus, double density) {
  spec.loading.speed_m_per_s = 1.0;
  const double length = scenes::build(spec)->length;
  const double wave_speed = std::sqrt(modulus * kModulus / (density * scenes::kDensity * 1e-12));
  const double frequency = 0.5 * std::numbers::pi * wave_speed / length;
  constexpr double kStrain = 2e-4;
  constexpr double kPeriods = 60.0;  // radians of the first mode
  spec.loading.end_strain = kStrain;
  spec.loading.ramp_strain = 0.2 * kStrain;
  spec.loading.speed_m_per_s = 1e-3 * kStrain * length * frequency / kPeriods;
  spec.numerics.mass_damping_per_s = 2.0 * frequency;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Sample& to = samples[samples.size() - 2];
  const Sample& from = samples[samples.size() / 2];
  const auto stress_of = [](const Sample& sample) { return 0.5 * (sample.stress_impact + sample.stress_support); };
  const double stress = stress_of(to) - stress_of(from);
  EXPECT_LT(std::abs(samples.back().energies.residual), 1e-5 * samples.back().energies.external);
  return {length, (to.travel - from.travel) / stress, (to.lateral_strain - from.lateral_strain) / stress};
}

class Strip : public testing::TestWithParam<OneLattice> {};

// Two lengths of strip: their difference has no ends and no contact.
TEST_P(Strip, OfTwoCellsHasTheModulusOfTheEndlessLattice) {
  for (const Direction direction : {Direction::x, Direction::y}) {
    const OneLattice& one = GetParam();
    SceneSpec spec = elastic_strip(one, direction, one.cells);
    const ClosedForms forms = kind_of(spec)->closed_forms(scenes::cells_of(spec), direction);
    const Slopes few = press(spec, forms.modulus, forms.density);
    const Slopes many = press(elastic_strip(one, direction, 2 * one.cells), forms.modulus, forms.density);
    const double modulus = (many.length - few.length) / (many.compliance - few.compliance) / kModulus;
    const double widening = (many.length * many.widening - few.length * few.widening) / (many.length - few.length);
    const double poissons_ratio = widening * modulus * kModulus;
    scenes::record_bound("E*", modulus / forms.modulus - 1.0, 5e-3);
    scenes::record_bound("nu", poissons_ratio - forms.poissons_ratio, 2e-2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Strip,
    testing::Values(
        OneLattice{"hexagon", "hexagon", 0.05, {}}, OneLattice{"hexagon_thick", "hexagon", 0.1, {}},
        OneLattice{"hexagon_flat", "hexagon", 0.05, {{"angle_degrees", 20.0}}, 12},
        OneLattice{"hexagon_steep", "hexagon", 0.05, {{"angle_degrees", 45.0}}},
        OneLattice{"hexagon_reentrant", "hexagon", 0.05, {{"angle_degrees", -30.0}, {"height_mm", 2.0 * kSide}}, 24},
        OneLattice{"square", "square", 0.05, {}}, OneLattice{"triangle", "triangle", 0.05, {}},
        OneLattice{"diamond", "diamond", 0.05, {}}, OneLattice{"kagome", "kagome", 0.02, {}, 10},
        OneLattice{"arrowhead", "arrowhead", 0.05, {}, 24},
        OneLattice{"hierarchical_hexagon", "hierarchical_hexagon", 0.01, {}}),
    [](const auto& of) { return of.param.name; });

/// Compliance and widening of a strip of four columns over those of one of two, minus 1.
std::pair<double, double> change_by_columns(const OneLattice& one, Direction direction, bool fixed_width) {
  const auto slopes_of = [&](int columns) {
    SceneSpec spec = elastic_strip(one, direction, 2, columns);
    spec.loading.sides.fixed_width = fixed_width;
    const ClosedForms forms = kind_of(spec)->closed_forms(scenes::cells_of(spec), direction);
    return press(spec, forms.modulus, forms.density);
  };
  const Slopes of_two = slopes_of(2);
  const Slopes of_four = slopes_of(4);
  return {of_four.compliance / of_two.compliance - 1.0, of_four.widening / of_two.widening - 1.0};
}

// Sinusoidal squares and rings too, whose curves need too many elements for the strips above.
TEST(PeriodicSides, ElasticStripsOfTwoAndOfFourColumnsAnswerAlike) {
  for (const LatticeKind* kind : lattice_kinds()) {
    SCOPED_TRACE(kind->name);
    const OneLattice one = {std::string(kind->name), std::string(kind->name), 0.05, {}};
    for (const Direction direction : {Direction::x, Direction::y}) {
      scenes::record_bound("of fixed width", change_by_columns(one, direction, true).first, 1e-6);
    }
  }
  for (const Direction direction : {Direction::x, Direction::y}) {
    const auto [compliance, widening] = change_by_columns({"hexagon", "hexagon", 0.05, {}}, direction, false);
    scenes::record_bound("compliance", compliance, 1e-3);
    scenes::record_bound("widening", widening, 1e-3);
  }
}

SceneSpec crushed_strip(int columns, int rows, double speed, double end_strain, bool fixed_width) {
  SceneSpec spec = scenes::hexagon_specimen(columns, rows);
  spec.imperfection = {};
  spec.loading.direction = Direction::y;
  spec.loading.speed_m_per_s = speed;
  spec.loading.end_strain = end_strain;
  spec.loading.sides = {Sides::Kind::periodic, 0.0, fixed_width, {}};
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.elements_per_wall = 4;
  spec.output.sample_count = 200;
  return spec;
}

/// Runs to the end, which must be reached.
std::vector<Sample> run(const SceneSpec& spec) {
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  std::vector<Sample> samples;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(scene->schedule.sample_interval);
    samples.push_back(simulation.take_sample());
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return samples;
}

double mean_stress(const std::vector<Sample>& samples, double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (const Sample& sample : samples) {
    if (sample.strain < from || sample.strain > to) continue;
    sum += 0.5 * (sample.stress_impact + sample.stress_support);
    ++count;
  }
  return sum / count;
}

// The sides cut nothing: two periods do twice what one does, until round-off has grown. In these re-entrant cells tips
// soon touch, of which half are the images of joints.
TEST(PeriodicSides, PeriodsSideBySideCrushAlike) {
  const auto crush = [](int columns) {
    SceneSpec spec = crushed_strip(columns, 6, 10.0, 0.055, true);
    RegularLattice& cells = scenes::cells_of(spec);
    cells.own = {{"angle_degrees", -30.0}, {"height_mm", 1.04 * *cells.side_mm + *cells.wall_thickness_mm}};
    spec.elements_per_wall = 2;
    return run(spec);
  };
  const std::vector<Sample> once = crush(2);
  const std::vector<Sample> twice = crush(4);
  ASSERT_EQ(once.size(), twice.size());
  double most = 0.0;
  double scale = 0.0;
  std::int64_t contacts = 0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    scale = std::max(scale, once[i].stress_impact);
    most = std::max(most, std::abs(once[i].stress_impact - twice[i].stress_impact) / scale);
    contacts = std::max(contacts, once[i].contact_count);
    EXPECT_EQ(2 * once[i].contact_count, twice[i].contact_count) << "at strain " << once[i].strain;
  }
  EXPECT_GT(contacts, 20);
  scenes::record_bound("stress", most, 1e-6);
}

TEST(PeriodicSides, CloseTheLedgerAndKeepTheMomentumAcross) {
  for (const bool fixed_width : {true, false}) {
    SceneSpec spec = crushed_strip(3, 10, 20.0, 0.7, fixed_width);
    spec.imperfection.amplitude_mm = 0.1;
    spec.contact.friction = 0.2;
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    double across = 0.0;
    Sample sample;
    while (simulation.status().kind == RunStatus::Kind::running) {
      simulation.advance(scene->schedule.sample_interval);
      sample = simulation.take_sample();
      // The images' masses are those of their walls: the whole moves as its centre.
      const double momentum = scenes::momentum_of(*scene, simulation.state()).linear.x();
      across = std::max(across, std::abs(momentum) / (scene->total_mass * 1e3 * 20.0));
    }
    EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
    EXPECT_GT(sample.contact_count, 20);
    scenes::record_bound("ledger", sample.energies.residual / sample.energies.external, 6e-3);
    scenes::record_bound("momentum across", across, 1e-6);
    EXPECT_EQ(sample.lateral_strain == 0.0, fixed_width);
  }
}

TEST(PeriodicSides, ResumeAndThreadsKeepTheBits) {
  SceneSpec spec = crushed_strip(3, 6, 40.0, 0.7, false);
  spec.imperfection.amplitude_mm = 0.1;
  spec.contact.friction = 0.2;
  const auto scene = scenes::build(spec);
  Simulation whole(scene);
  Simulation two(scene, 2);
  const std::int64_t half = scene->schedule.step_count / 2;
  whole.advance(half);
  two.advance(half);
  ASSERT_EQ(scenes::hash_of(whole.state()), scenes::hash_of(two.state()));
  const std::string checkpoint = scenes::checkpoint_of(whole);
  Simulation resumed(scene);
  ASSERT_TRUE(resumed.restore(source_of(checkpoint)));
  whole.advance(half / 2);
  two.advance(half / 2);
  resumed.advance(half / 2);
  EXPECT_GT(whole.state().contact_totals.count, 5);
  EXPECT_EQ(scenes::hash_of(whole.state()), scenes::hash_of(two.state()));
  EXPECT_EQ(scenes::hash_of(whole.state()), scenes::hash_of(resumed.state()));
}

TEST(PeriodicSides, HexagonsCollapseAtTheStressOfTheirHinges) {
  SceneSpec spec = crushed_strip(2, 6, 0.5, 0.05, false);
  spec.material.hardening_modulus_mpa = 0.0;
  const auto scene = scenes::build(spec);
  const std::vector<Sample> samples = run(spec);
  scenes::record_bound("collapse", mean_stress(samples, 0.01, 0.03) / scene->collapse_stress - 1.0, 0.1);
}

// Until the symmetry breaks. From there on the width decides where cells fold, as it does between any sides.
TEST(PeriodicSides, CollapseOfFewColumnsIsThatOfMany) {
  const auto collapse = [](int columns, bool periodic) {
    SceneSpec spec = crushed_strip(columns, 6, 1.0, 0.04, false);
    spec.elements_per_wall = 2;
    spec.loading.ramp_strain = 0.002;
    if (!periodic) spec.loading.sides = {};
    return mean_stress(run(spec), 0.01, 0.04);
  };
  const double periodic = std::abs(collapse(2, true) / collapse(8, true) - 1.0);
  const double free = std::abs(collapse(2, false) / collapse(8, false) - 1.0);
  scenes::record_bound("of two columns", periodic, 0.02);
  EXPECT_LT(periodic, 0.1 * free);
}

TEST(PeriodicSides, OfRingsJoinThemAcrossTheSides) {
  for (const Direction direction : {Direction::x, Direction::y}) {
    SceneSpec spec = crushed_strip(2, 2, 5.0, 0.02, false);
    spec.lattice = RegularLattice{"anti_tetrachiral", 2, 2, 10.0, 0.2, {}};
    spec.loading.direction = direction;
    const auto scene = scenes::build(spec);
    EXPECT_NEAR(scene->width, 20.0, 1e-9);
    EXPECT_EQ(scene->period.low.size(), 3U);  // ligaments across, one for each ring along the crush
    const Sample last = run(spec).back();
    EXPECT_LT(last.lateral_strain, 0.0) << "auxetic";
    EXPECT_LT(std::abs(last.energies.residual), 6e-3 * last.energies.external);
  }
}

TEST(PeriodicSides, GoWithMissingWallsAndScatter) {
  SceneSpec spec = crushed_strip(4, 6, 20.0, 0.3, false);
  spec.changes.defects.missing_walls = 0.05;
  spec.changes.defects.thickness_scatter = 0.1;
  const auto scene = scenes::build(spec);
  const auto whole = scenes::build(crushed_strip(4, 6, 20.0, 0.3, false));
  EXPECT_LT(scene->walls.start.size(), whole->walls.start.size());
  EXPECT_NEAR(scene->width, whole->width, 1e-9);
  EXPECT_GE(scene->period.low.size(), 3U) << "a missing wall takes the image at its end with it";
  const Sample last = run(spec).back();
  EXPECT_LT(std::abs(last.energies.residual), 6e-3 * last.energies.external);
}

SceneSpec voronoi_strip(int columns, int rows, double irregularity, Direction direction) {
  VoronoiWalls walls;
  walls.columns = columns;
  walls.rows = rows;
  walls.side_mm = kSide;
  walls.irregularity = irregularity;
  walls.seed = 3;
  walls.wall_thickness_mm = 0.05 * kSide;
  SceneSpec spec = elastic_strip({"hexagon", "hexagon", 0.05, {}}, direction, 6);
  spec.lattice = walls;
  spec.numerics.rigid_link_slenderness = 0.0;
  return spec;
}

TEST(PeriodicSides, OfRegularVoronoiWallsGiveTheModulusOfHexagons) {
  for (const Direction direction : {Direction::x, Direction::y}) {
    const bool along_x = direction == Direction::x;
    const SceneSpec hexagons = elastic_strip({"hexagon", "hexagon", 0.05, {}}, direction, 6);
    const ClosedForms forms = kind_of(hexagons)->closed_forms(scenes::cells_of(hexagons), direction);
    const auto slopes_of = [&](int cells) {
      const SceneSpec spec = voronoi_strip(along_x ? cells : 4, along_x ? 4 : cells, 0.0, direction);
      return press(spec, forms.modulus, forms.density);
    };
    const Slopes few = slopes_of(6);
    const Slopes many = slopes_of(12);
    const double modulus = (many.length - few.length) / (many.compliance - few.compliance) / kModulus;
    scenes::record_bound("E*", modulus / forms.modulus - 1.0, 5e-3);
  }
}

// Joints of one period have the walls of an endless foam; those at the plates end there.
TEST(PeriodicSides, LetVoronoiWallsLeadFromOnePeriodIntoTheNext) {
  for (const Direction direction : {Direction::x, Direction::y}) {
    const int axis = direction == Direction::x ? 0 : 1;
    SceneSpec spec = voronoi_strip(6, 8, 0.5, direction);
    auto& walls = std::get<VoronoiWalls>(spec.lattice);
    walls.wall_thickness_mm.reset();
    walls.relative_density = 0.06;
    spec.loading.speed_m_per_s = 1.0;
    const auto scene = scenes::build(spec);
    EXPECT_NEAR(scene->width, axis == 0 ? 1.5 * kSide * 8 : std::sqrt(3.0) * kSide * 6, 1e-9);
    EXPECT_NEAR(relative_density_of(*scene), 0.06, 1e-9);
    EXPECT_GE(scene->period.low.size(), 6U);
    std::vector<int> ends(scene->joint_count, 0);
    std::vector<int> joint(scene->joint_count);
    std::iota(joint.begin(), joint.end(), 0);
    for (std::size_t p = 0; p < scene->period.low.size(); ++p) joint[scene->period.high[p]] = scene->period.low[p];
    for (std::size_t wall = 0; wall < scene->walls.start.size(); ++wall) {
      ++ends[joint[scene->walls.start[wall]]];
      ++ends[joint[scene->walls.end[wall]]];
    }
    int at_plates = 0;
    for (int i = 0; i < scene->joint_count; ++i) {
      if (joint[i] != i || ends[i] >= 3) continue;
      const double place = scene->position[i][axis];
      // An end that the cut leaves shorter than a thousandth of a wall is none.
      EXPECT_LT(std::min(std::abs(place), std::abs(place - scene->length)), ends[i] == 1 ? 1e-9 : 1e-3 * kSide);
      ++at_plates;
    }
    EXPECT_GT(at_plates, 8);
    walls.columns = walls.rows = 2;
    EXPECT_EQ(scenes::build(spec)->period.repeats(), true);
  }
}

TEST(PeriodicSides, CrushAVoronoiHoneycombWithAClosedLedger) {
  SceneSpec spec = crushed_strip(3, 4, 50.0, 0.65, false);
  spec.lattice = std::get<VoronoiWalls>(voronoi_strip(3, 4, 0.2, Direction::y).lattice);
  spec.numerics.rigid_link_slenderness = 0.0;
  spec.elements_per_wall = 2;
  spec.depth_mm = 1.0;
  const Sample last = run(spec).back();
  EXPECT_GE(last.contact_count, 5);
  scenes::record_bound("ledger", last.energies.residual / last.energies.external, 6e-3);
}

std::string fields_of(const SceneSpec& spec) {
  std::string fields;
  for (const Problem& problem : build_scene(spec).problems) fields += problem.field + ' ';
  return fields;
}

TEST(PeriodicSides, AreRefusedWithAField) {
  const SceneSpec good = crushed_strip(3, 4, 10.0, 0.3, false);
  EXPECT_EQ(fields_of(good), "");
  const auto with = [&](auto change) {
    SceneSpec spec = good;
    change(spec);
    return fields_of(spec);
  };
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.loading.direction = Direction::x;
              scenes::cells_of(spec).rows = 3;
            }),
            "lattice.hexagon.rows ");
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.lattice = RegularLattice{"anti_tetrachiral", 3, 4, 10.0, 0.2, {}};
              spec.elements_per_wall = 4;
            }),
            "lattice.anti_tetrachiral.columns ");
  EXPECT_EQ(with([](SceneSpec& spec) { spec.loading.sides.period_mm = 10.0; }), "loading.sides.period_mm ");
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.loading.sides = {Sides::Kind::free, 0.0, true, {}};
            }),
            "loading.sides.fixed_width ");
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.loading.sides = {Sides::Kind::rigid, 0.0, false, 9.0};
            }),
            "loading.sides.period_mm ");
  EXPECT_EQ(with([](SceneSpec& spec) { spec.changes.rotation_degrees = 10.0; }), "lattice.rotation_degrees ");
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.changes.outline.corners_mm = {0.0, 0.0, 20.0, 20.0};
            }),
            "lattice.outline.corners_mm ");
  EXPECT_EQ(with([](SceneSpec& spec) { spec.changes.grading.size_steps = {1.0, 1.2}; }), "lattice.grading.size_steps ");
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.inclusions.rows = {2};
              spec.inclusions.model = Inclusions::Model::rigid;
            }),
            "lattice.inclusions.model ");
  EXPECT_EQ(with([](SceneSpec& spec) { spec.loads.grips = {{LoadsSpec::Grip::Edge::top, {}}}; }), "loading.grips ");
  EXPECT_EQ(with([](SceneSpec& spec) {
              spec.loads.rigid_walls = {{-100.0, 0.0, 1.0, 0.0}};
            }),
            "loading.rigid_walls[0].normal_x ");
}

/// A strip of squares as a network, `columns` walls along x in each row; with `both` the walls at both sides.
SceneSpec network_strip(int columns, bool both, double period) {
  NetworkWalls network;
  network.wall_thickness_mm = 0.5;
  constexpr int kRows = 3;
  for (int y = 0; y <= kRows; ++y) {
    for (int x = 0; x <= columns; ++x) network.joints_mm.insert(network.joints_mm.end(), {kSide * x, kSide * y});
  }
  const auto joint = [&](int x, int y) { return y * (columns + 1) + x; };
  for (int y = 0; y <= kRows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      if (x < columns) network.walls.insert(network.walls.end(), {joint(x, y), joint(x + 1, y)});
      if (y < kRows && (both || x < columns)) network.walls.insert(network.walls.end(), {joint(x, y), joint(x, y + 1)});
    }
  }
  SceneSpec spec = crushed_strip(2, 2, 10.0, 0.1, false);
  spec.lattice = network;
  spec.loading.sides.period_mm = period;
  return spec;
}

TEST(PeriodicSides, OfANetworkAreThoseOfTheSameLattice) {
  SceneSpec squares = network_strip(3, false, 3 * kSide);
  const std::vector<Sample> of_network = run(squares);
  squares.lattice = scenes::squares(3, 3, kSide, 0.5);
  squares.loading.sides.period_mm = {};
  const std::vector<Sample> of_squares = run(squares);
  EXPECT_NEAR(mean_stress(of_network, 0.0, 0.1) / mean_stress(of_squares, 0.0, 0.1), 1.0, 0.02);
  EXPECT_EQ(fields_of(network_strip(3, true, 3 * kSide)), "lattice.network.walls[12] ");
  EXPECT_EQ(fields_of(network_strip(3, false, 3.01 * kSide)), "loading.sides.period_mm ");
  EXPECT_EQ(fields_of(network_strip(3, false, kSide)), "lattice.network.walls[4] ");
  SceneSpec without = network_strip(3, false, 0.0);
  EXPECT_EQ(fields_of(without), "loading.sides.period_mm ");
  without.loading.sides.period_mm = {};
  EXPECT_EQ(fields_of(without), "loading.sides.period_mm ");
}

}  // namespace
}  // namespace cellcrush::periodic
