// What stands at the edges of a lattice: rigid side walls (E9h) and grips (E15a). Pins between
// plates, and the walls that they join in contact (E16). Blind to: the law of contact and of
// friction at rigid walls, and reactions of supports, which have tests of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush::boundaries {
namespace {

using Grip = LoadsSpec::Grip;
using Sides = LoadingSpec::Sides;

constexpr double kModulus = 70000.0;  // MPa

/// Elastic rhombi whose walls all rise at an angle, `columns` x `rows` of them between joints on all four edges. The
/// edges are lines of symmetry of the endless lattice, so that smooth plates and sides leave it as it is there, but for
/// the walls at its corners.
struct Rhombi {
  static constexpr double kSide = 10.0;  // L, mm
  static constexpr double kThickness = 1.0;
  static constexpr double kRatio = kThickness / kSide;

  double angle;  ///< of the walls to x, rad
  int columns;
  int rows;

  /// Under strains without shear no joint turns, and the ends of a wall move by L (e_x cos, e_y sin): an axial force
  /// E h / L and a shear force E (h/L)^3 for each mm, two walls for each area of 2 L^2 sin cos.
  [[nodiscard]] double stiffness(double along_x, double along_y, bool is_mixed) const {
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    const double bending = kRatio * kRatio * s * s * c * c;
    return kModulus * kRatio / (s * c) * (along_x * along_y + (is_mixed ? -bending : bending));
  }
  [[nodiscard]] double along() const {
    return stiffness(std::pow(std::cos(angle), 2), std::pow(std::cos(angle), 2), false);
  }
  [[nodiscard]] double across() const {
    return stiffness(std::pow(std::sin(angle), 2), std::pow(std::sin(angle), 2), false);
  }
  [[nodiscard]] double mixed() const {
    return stiffness(std::pow(std::cos(angle), 2), std::pow(std::sin(angle), 2), true);
  }
  [[nodiscard]] double free_modulus() const { return along() - mixed() * mixed() / across(); }
  /// 1 - nu_xy nu_yx
  [[nodiscard]] double suppressed() const { return 1.0 - mixed() * mixed() / (along() * across()); }

  [[nodiscard]] SceneSpec spec() const {
    NetworkWalls network;
    network.wall_thickness_mm = kThickness;
    const double x = kSide * std::cos(angle);
    const double y = kSide * std::sin(angle);
    std::vector<int> joint_at(static_cast<std::size_t>((2 * columns + 1) * (2 * rows + 1)), -1);
    const auto joint = [&](int i, int j) {
      int& number = joint_at[static_cast<std::size_t>(j * (2 * columns + 1) + i)];
      if (number < 0) {
        number = static_cast<int>(network.joint_count());
        network.joints_mm.insert(network.joints_mm.end(), {i * x, j * y});
      }
      return number;
    };
    for (int i = 0; i < 2 * columns; ++i) {
      for (int j = 0; j < 2 * rows; ++j) {
        const bool rises = (i + j) % 2 == 0;
        const int from = joint(i, rises ? j : j + 1);
        network.walls.insert(network.walls.end(), {from, joint(i + 1, rises ? j + 1 : j)});
      }
    }
    SceneSpec spec;
    spec.lattice = network;
    spec.depth_mm = 2.0;
    spec.elements_per_wall = 1;
    spec.material.youngs_modulus_mpa = kModulus;
    spec.material.yield_stress_mpa = 1e6;
    spec.material.density_kg_per_m3 = scenes::kDensity;
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
    spec.contact.impact_speed_m_per_s = 800.0;  // for stiff contacts
    spec.numerics.mass_damping_per_s = 1e4;
    spec.loading.speed_m_per_s = 0.05;
    spec.loading.ramp_strain = 2e-4;
    spec.loading.end_strain = 1e-3;
    spec.output.sample_count = 20;
    return spec;
  }
};

SceneSpec between_sides(SceneSpec spec, double friction = 0.0) {
  spec.loading.sides = {Sides::Kind::rigid, friction, false, {}};
  return spec;
}

/// Sample number `back` before the last full interval of a run.
const Sample& before_end(const std::vector<Sample>& samples, std::size_t back) {
  return samples[samples.size() - 2 - back];
}

/// Slope of a mean over the intervals between samples: from the middle to the end of a run.
template <class Mean, class Place>
double slope_of(const std::vector<Sample>& samples, const Mean& mean, const Place& place) {
  const Sample& from = before_end(samples, samples.size() / 2);
  const Sample& to = before_end(samples, 0);
  return (mean(to) - mean(from)) / (place(to) - place(from));
}

double stress_of(const Sample& sample) { return 0.5 * (sample.stress_impact + sample.stress_support); }

double ledger_error(const Sample& sample) { return std::abs(sample.energies.residual) / sample.energies.external; }

constexpr double kRight = std::numbers::pi / 4.0;
constexpr double kFlat = std::numbers::pi / 6.0;

TEST(SideWalls, ConfineABlockToItsConfinedModulus) {
  double modulus = 0.0;
  double across = 0.0;
  double closure = 0.0;
  double ledger = 0.0;
  for (const double angle : {kRight, kFlat}) {
    const Rhombi rhombi = {angle, 4, 4};
    const std::vector<Sample> samples = scenes::run_frame(between_sides(rhombi.spec()));
    const auto strain = [](const Sample& sample) { return sample.strain; };
    const double area = rhombi.columns * 2.0 * Rhombi::kSide * std::cos(angle) * *rhombi.spec().depth_mm;
    const auto low = [](const Sample& sample) { return sample.rigid_walls.at(0).normal_force; };
    const auto high = [](const Sample& sample) { return sample.rigid_walls.at(1).normal_force; };
    EXPECT_GT(1.0 / rhombi.suppressed(), 15.0) << "confinement must matter";
    const double confined = rhombi.free_modulus() / rhombi.suppressed();
    modulus = std::max(modulus, std::abs(slope_of(samples, stress_of, strain) / confined - 1.0));
    across = std::max(across, std::abs(slope_of(samples, low, strain) / (area * rhombi.mixed()) - 1.0));
    closure = std::max(closure, std::abs(low(samples.back()) / high(samples.back()) - 1.0));
    ledger = std::max(ledger, ledger_error(samples.back()));
  }
  scenes::record_bound("modulus", modulus, 0.02);
  scenes::record_bound("stress across", across, 0.02);
  scenes::record_bound("forces of both sides", closure, 1e-6);
  scenes::record_bound("ledger", ledger, 1e-6);
}

TEST(SideWalls, LeftOutTheSameBlockHasItsFreeModulus) {
  const Rhombi rhombi = {kRight, 6, 6};  // the walls at its corners turn there, 4 of 144
  SceneSpec spec = rhombi.spec();
  spec.contact.impact_speed_m_per_s = 300.0;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  EXPECT_TRUE(samples.back().rigid_walls.empty());
  const double slope = slope_of(samples, stress_of, [](const Sample& sample) { return sample.strain; });
  scenes::record_bound("modulus", slope / rhombi.free_modulus() - 1.0, 0.03);
}

TEST(SideWalls, BearByFrictionWhatTheSupportPlateDoesNot) {
  const Rhombi rhombi = {kRight, 6, 3};
  const std::vector<Sample> samples = scenes::run_frame(between_sides(rhombi.spec(), 0.3));
  const Sample& last = before_end(samples, 0);
  const double area = rhombi.rows * 2.0 * Rhombi::kSide * std::sin(kRight) * *rhombi.spec().depth_mm;
  // Friction is positive along the normal turned clockwise: +x at the low side, -x at the high one.
  const double rubbed = last.rigid_walls.at(1).tangential_force - last.rigid_walls.at(0).tangential_force;
  const double missing = area * (last.stress_impact - last.stress_support);
  EXPECT_GT(missing, 0.2 * area * last.stress_impact);
  scenes::record_bound("balance", rubbed / missing - 1.0, 5e-3);
  scenes::record_bound("ledger", ledger_error(last), 1e-6);
}

TEST(SideWalls, AreNamedAndRefusedWithAField) {
  SceneSpec spec = Rhombi{kRight, 2, 2}.spec();
  spec.loading.sides.friction = 0.2;
  const Problems problems = build_scene(spec).problems;
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].field, "loading.sides.friction");
  spec.loading.sides.kind = Sides::Kind::rigid;
  const std::vector<std::string> modelled = facts_of(*scenes::build(spec)).modelled;
  EXPECT_TRUE(std::ranges::any_of(modelled, [](const std::string& line) {
    return line.starts_with("Side walls: 2 half planes") && line.find("Poisson's ratio") != std::string::npos;
  }));
}

/// Five rows of squares 50 mm long, elastic.
SceneSpec squares() {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.lattice = scenes::squares(5, 4, 10.0, 0.5);
  spec.imperfection = {};
  spec.elements_per_wall = 2;
  spec.material.yield_stress_mpa = 1e6;
  spec.material.youngs_modulus_mpa = kModulus;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.loading = {};
  return spec;
}

TEST(Grips, PullABlockOfSquaresWithTheStiffnessOfItsWalls) {
  SceneSpec spec = squares();
  constexpr double kEnd = 2e-3;   // s
  constexpr double kPull = 0.05;  // mm
  spec.loading.end_time_s = kEnd;
  spec.loads.grips = {{Grip::Edge::left, std::nullopt, Grip::FixedTo::ground, {}, {}},
                      {Grip::Edge::right, 45.0, Grip::FixedTo::ground, {{0.0, 0.0}, {kEnd, kPull}}, {}}};
  spec.numerics.mass_damping_per_s = 1e4;
  spec.output.sample_count = 20;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  // Of the walls along the pull, between the edge and the middles of the last walls, which lie on the line.
  const double stiffness = 5.0 * kModulus * 0.5 * *spec.depth_mm / 45.0;
  const auto pulled = [](const Sample& sample) { return 0.5 * (sample.grips[1].force_x - sample.grips[0].force_x); };
  const double slope = slope_of(samples, pulled, [](const Sample& sample) { return sample.grips[1].displacement_x; });
  const Energies& energies = samples.back().energies;
  EXPECT_EQ(samples.back().grips[0].displacement_x, 0.0);
  EXPECT_NEAR(samples.back().grips[1].displacement_x, kPull, 1e-4 * kPull);
  scenes::record_bound("stiffness", slope / stiffness - 1.0, 0.01);
  scenes::record_bound("work", energies.external / (0.5 * stiffness * kPull * kPull) - 1.0, 0.02);
  scenes::record_bound("ledger", ledger_error(samples.back()), 1e-6);
}

// Exact in the solver: the velocities at half steps change by the forces between them.
TEST(Grips, OfPlatesAddTheirForcesToTheStresses) {
  SceneSpec spec = scenes::hexagon_specimen(6, 5);
  spec.loading.end_strain = 0.1;
  spec.output.sample_count = 100;
  spec.loads.grips = {{Grip::Edge::left, std::nullopt, Grip::FixedTo::impact_plate, {}, {}},
                      {Grip::Edge::right, std::nullopt, Grip::FixedTo::support_plate, {}, {}}};
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const auto momentum = [&] { return scenes::momentum_of(*scene, simulation.state()).linear.x(); };
  const double before = momentum();
  double impulse = 0.0;
  double of_grips = 0.0;
  double time = 0.0;
  Sample sample;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(scene->schedule.sample_interval);
    sample = simulation.take_sample();
    impulse += scene->width * scene->depth * (sample.stress_impact - sample.stress_support) * (sample.time - time);
    of_grips += (sample.grips[0].force_x + sample.grips[1].force_x) * (sample.time - time);
    time = sample.time;
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  EXPECT_NEAR(sample.grips[0].displacement_x, sample.travel, 1e-9);
  EXPECT_EQ(sample.grips[1].displacement_x, 0.0);
  EXPECT_GT(std::abs(of_grips), 0.5 * std::abs(impulse)) << "the grips must bear";
  scenes::record_bound("impulse", (momentum() - before) / impulse - 1.0, 1e-9);
  scenes::record_bound("ledger", ledger_error(sample), 0.01);
}

TEST(Grips, AreRefusedWithAField) {
  const auto field_of = [](const std::vector<Grip>& grips, double speed = 0.0) {
    SceneSpec spec = squares();
    if (speed > 0.0) {
      spec.loading.speed_m_per_s = speed;
    } else {
      spec.loading.end_time_s = 1e-5;
    }
    spec.loads.grips = grips;
    std::string fields;
    for (const Problem& problem : build_scene(spec).problems) fields += problem.field + ' ';
    return fields;
  };
  using FixedTo = Grip::FixedTo;
  EXPECT_EQ(field_of({{Grip::Edge::left, 20.0}, {Grip::Edge::right, 30.0}}), "");
  EXPECT_EQ(field_of({{Grip::Edge::left, 30.0}, {Grip::Edge::right, 20.0}}), "loading.grips[1] ");
  EXPECT_EQ(field_of({{Grip::Edge::left, -1.0}}), "loading.grips[0].line_mm ");
  EXPECT_EQ(field_of({{Grip::Edge::left, std::nullopt, FixedTo::impact_plate}}), "loading.grips[0].fixed_to ");
  EXPECT_EQ(field_of({{Grip::Edge::top, std::nullopt, FixedTo::impact_plate}}, 1.0), "loading.grips[0].edge ");
  EXPECT_EQ(field_of({{Grip::Edge::right, std::nullopt, FixedTo::support_plate, {{0.0, 0.0}, {1.0, 1.0}}}}, 1.0),
            "loading.grips[0].displacement_x_mm ");
  EXPECT_EQ(field_of({{Grip::Edge::left, std::nullopt, FixedTo::ground, {{1.0, 0.0}, {1.0, 1.0}}}}),
            "loading.grips[0].displacement_x_mm.points ");
}

/// A rhombus of stout bars whose long diagonal is a thin tie, crushed along the short one. All ends are pinned.
struct TiedRhombus {
  static constexpr double kHeight = 5.0;  // half of the short diagonal, mm
  static constexpr double kWidth = 8.0;   // half of the tie
  static constexpr double kBar = 0.8;
  static constexpr double kTie = 0.1;
  static constexpr double kFriction = 0.5;

  static SceneSpec spec(int elements, double speed, double end_strain) {
    FrameLattice frame;
    frame.nodes = {
        {0.0, -kHeight, 0.0, 0.0}, {kWidth, 0.0, 0.0, 0.0}, {0.0, kHeight, 0.0, 0.0}, {-kWidth, 0.0, 0.0, 0.0}};
    for (int i = 0; i < 4; ++i) frame.beams.push_back(scenes::beam(i, (i + 1) % 4, kBar, elements));
    frame.beams.push_back(scenes::beam(1, 3, kTie, elements));
    for (FrameLattice::Beam& beam : frame.beams) beam.pin_start = beam.pin_end = true;
    frame.self_contact = true;
    SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
    spec.loading = {};
    spec.loading.direction = LoadingSpec::Direction::y;
    spec.loading.speed_m_per_s = speed;
    spec.loading.end_strain = end_strain;
    spec.loading.ramp_strain = 0.2 * end_strain;
    spec.contact.impact_speed_m_per_s = 200.0;  // stiff contacts
    spec.plates.friction = kFriction;           // lest it tips over
    return spec;
  }

  /// Force F of the plates at a travel, of pin-jointed bars: statics at the joints and the stretch of bars and tie. The
  /// ends of the bars, of radius R, also turn against the plates, which takes mu F R / x more.
  static double force(double travel) {
    const double y = kHeight - 0.5 * travel;
    const double whole = std::hypot(kHeight, kWidth);
    double low = kWidth;
    double high = whole;
    double push = 0.0;
    while (high - low > 1e-12) {
      const double x = 0.5 * (low + high);
      const double length = std::hypot(x, y);
      push = kModulus * kBar * (whole / length - 1.0);
      const double pull = kModulus * kTie * (x / kWidth - 1.0);
      (2.0 * push * x / length > pull ? low : high) = x;
    }
    return 2.0 * push * y / std::hypot(low, y) / (1.0 - kFriction * 0.5 * kBar / low);
  }
};

TEST(PinsBetweenPlates, BearWhatStaticsOfTheTrussSays) {
  SceneSpec spec = TiedRhombus::spec(1, 0.05, 0.02);
  spec.numerics.mass_damping_per_s = 5000.0;
  spec.output.sample_count = 50;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Sample& last = before_end(samples, 0);
  const double area = 2.0 * TiedRhombus::kWidth;
  // The mean over an interval is the force in its middle.
  const double exact = 0.5 * (TiedRhombus::force(last.travel) + TiedRhombus::force(before_end(samples, 1).travel));
  scenes::record_bound(
      "force",
      std::max(std::abs(area * last.stress_impact / exact - 1.0), std::abs(area * last.stress_support / exact - 1.0)),
      2e-3);
  scenes::record_bound("ledger", ledger_error(samples.back()), 1e-6);
}

TEST(PinsBetweenPlates, FoldWallsOnEachOtherWithoutEnergyOfContact) {
  SceneSpec spec = TiedRhombus::spec(6, 5.0, 0.7);
  spec.output.sample_count = 200;
  const auto scene = scenes::build(spec);
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Summary summary = summarize(*scene, samples);
  std::int64_t contacts = 0;
  for (const Sample& sample : samples) contacts = std::max(contacts, sample.contact_count);
  EXPECT_GT(contacts, 0);
  EXPECT_LT(summary.deepest_penetration, 0.5);
  scenes::record_bound("ledger", summary.energy_error_relative, 1e-3);
}

}  // namespace
}  // namespace cellcrush::boundaries
