// Walls that break: rods, beams and bars against closed forms, free bodies that keep their momentum, and ends that
// touch again. Blind to: walls that bend and stretch at once, and cycles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/spec_checker.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"

namespace cellcrush::fracture {
namespace {

using Component = FrameLattice::Component;

constexpr double kModulus = 70000.0;  // MPa
constexpr double kYield = 140.0;      // MPa
constexpr double kDensity = 2700.0;   // kg/m^3
constexpr double kLength = 40.0;      // mm
constexpr double kThickness = 1.0;    // mm, and 1 mm deep
/// M_p and the moment at which a surface yields, N mm.
constexpr double kFullMoment = 0.25 * kYield;
constexpr double kFirstMoment = kYield / 6.0;

SceneSpec failing(FrameLattice frame, double failure_strain) {
  SceneSpec spec = scenes::plastic_frame(std::move(frame), kModulus, kYield, kDensity);
  spec.material.failure_strain = failure_strain;
  return spec;
}

/// A bar along x, clamped at its start. Its other end is moved slowly by `end` mm.
SceneSpec moved_bar(int elements, Component component, double end, double failure_strain) {
  FrameLattice frame = scenes::bar(kLength, kThickness, elements);
  frame.supports.push_back({0, true, true, true});
  frame.end_time_s = 2e-2;
  frame.motions.push_back({1, component, {{0.0, 0.0}, {*frame.end_time_s, end}}});
  return failing(frame, failure_strain);
}

std::vector<Break> breaks_of(const std::vector<Sample>& samples) {
  std::vector<Break> breaks;
  for (const Sample& sample : samples) breaks.insert(breaks.end(), sample.breaks.begin(), sample.breaks.end());
  return breaks;
}

/// What the end of the bar has been moved by as it breaks, mm.
double displacement_at_break(const SceneSpec& spec, double end) {
  const std::vector<Break> breaks = breaks_of(scenes::run_frame(spec));
  EXPECT_FALSE(breaks.empty());
  return breaks.empty() ? 0.0 : breaks.front().time / *spec.loading.end_time_s * end;
}

// A perfectly plastic rod necks from the first: beyond its elastic elongation the neck has the failure strain over a
// thickness, however long its elements are.
TEST(Fracture, APerfectlyPlasticRodBreaksInANeckOfAThickness) {
  constexpr double kFailure = 0.2;
  const double expected = kYield / kModulus * kLength + kFailure * kThickness;
  for (const int elements : {2, 4, 8}) {
    const SceneSpec spec = moved_bar(elements, Component::x, 1.0, kFailure);
    EXPECT_NEAR(displacement_at_break(spec, 1.0) / expected, 1.0, 0.005) << elements;
  }
}

// A rod that hardens by H stretches evenly to 1 - sigma_y / H (Considere), with a stress of H; then it necks.
TEST(Fracture, AHardeningRodStretchesEvenlyFirst) {
  constexpr double kHardening = 700.0;
  constexpr double kFailure = 0.9;
  const double even = 1.0 - kYield / kHardening;
  const double expected = (even + kHardening / kModulus) * kLength + (kFailure - even) * kThickness;
  for (const int elements : {2, 8}) {
    SceneSpec spec = moved_bar(elements, Component::x, 40.0, kFailure);
    spec.material.hardening_modulus_mpa = kHardening;
    EXPECT_NEAR(displacement_at_break(spec, 40.0) / expected, 1.0, 0.005) << elements;
  }
}

// A brittle cantilever breaks at its clamp when its surface reaches the strength.
TEST(Fracture, ABrittleCantileverBreaksAtItsStrength) {
  const double force = kFirstMoment / kLength;
  const double expected = force * kLength * kLength * kLength / (3.0 * kModulus / 12.0);
  for (const int elements : {2, 4, 8}) {
    const SceneSpec spec = moved_bar(elements, Component::y, 3.0, 1e-5);
    const std::vector<Break> breaks = breaks_of(scenes::run_frame(spec));
    ASSERT_FALSE(breaks.empty());
    EXPECT_NEAR(breaks.front().place.norm(), 0.0, 1e-9) << elements;
    EXPECT_NEAR(breaks.front().time / *spec.loading.end_time_s * 3.0 / expected, 1.0, 0.02) << elements;
  }
}

/// Energy that a beam on two supports takes until it is broken in the middle, N mm.
double energy_to_break(int elements_of_half, double failure_strain) {
  constexpr double kHalf = 10.0;
  FrameLattice frame;
  frame.nodes = {{-kHalf, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, {kHalf, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, elements_of_half), scenes::beam(1, 2, kThickness, elements_of_half)};
  frame.supports = {{0, false, true, false}, {2, false, true, false}};
  frame.end_time_s = 1e-2;
  frame.motions.push_back({1, Component::y, {{0.0, 0.0}, {*frame.end_time_s, -5.0}}});
  frame.motions.push_back({1, Component::x, {{0.0, 0.0}, {*frame.end_time_s, 0.0}}});
  frame.watched_nodes = {1};
  const std::vector<Sample> samples = scenes::run_frame(failing(frame, failure_strain));
  EXPECT_EQ(samples.back().break_count, 2) << elements_of_half;
  const Energies& energies = samples.back().energies;
  EXPECT_LT(std::abs(energies.residual), 2e-3 * energies.external) << elements_of_half;
  EXPECT_LT(std::abs(samples.back().watched.front().rotation), 0.1) << "nothing is left of the joint that could spin";
  return energies.plastic + energies.fracture;
}

// A hinge turns by twice the failure strain on either side of the middle. The beam yields beyond the hinge, too, over a
// third of its length: at small failure strains that adds a few per cent. Larger ones than these are not looked at: a
// perfectly plastic beam may then turn in the hinge of one side alone.
TEST(Fracture, TheEnergyOfABrokenBeamDoesNotDependOnTheMesh) {
  for (const double failure : {0.02, 0.05, 0.1, 0.2}) {
    const double of_hinges = kFullMoment * 4.0 * failure;
    const double fine = energy_to_break(8, failure);
    scenes::record_bound("broken beam: error of its energy", fine / of_hinges - 1.0, 0.03);
    for (const int elements : {2, 4}) {
      scenes::record_bound("broken beam: error of fewer elements", energy_to_break(elements, failure) / fine - 1.0,
                           0.03);
    }
  }
}

// The front part of a bar flies onto the rest: a pulse of twice its length runs to the free end, comes back as tension,
// and tears off as much as the flyer is long. It leaves with the speed of the flyer. The metal hardens so steeply that
// waves hardly notice where it yields; it breaks at 80 % of the stress of the pulse.
TEST(Fracture, AStruckBarSpallsAsFarFromItsEndAsTheFlyerIsLong) {
  constexpr double kFlyer = 50.0;
  constexpr double kBar = 400.0;
  constexpr double kSpeed = 20.0;                                // m/s
  constexpr double kSteep = 1e3;                                 // hardening modulus over Young's
  constexpr double kLeastYield = 1.0;                            // MPa
  const double wave = std::sqrt(kModulus / (1e-12 * kDensity));  // mm/s
  const double pulse = 0.5e-12 * kDensity * wave * 1e3 * kSpeed;
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kFlyer, 0.0, 0.0, 0.0}, {kBar, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, 100), scenes::beam(1, 2, kThickness, 700)};
  frame.initial_velocities = {{0, kSpeed, 0.0, 0.0}, {1, kSpeed, 0.0, 0.0}};
  frame.end_time_s = (kBar + 3.0 * kFlyer) / wave;
  SceneSpec spec = failing(frame, (0.8 * pulse - kLeastYield) / (kSteep * kModulus));
  spec.material.yield_stress_mpa = kLeastYield;
  spec.material.hardening_modulus_mpa = kSteep * kModulus;
  spec.material.isotropic_fraction = 0.0;
  Simulation simulation(scenes::build(spec));
  const std::vector<Break> breaks = breaks_of(scenes::run_to_end(simulation));
  ASSERT_FALSE(breaks.empty());
  const double place = breaks.front().place.x();
  scenes::record_figure("spall of a bar: its length over that of the flyer", (kBar - place) / kFlyer, 3, {1.0, 0.05});
  const State& state = simulation.state();
  const Scene& scene = simulation.scene();
  double mass = 0.0;
  double momentum = 0.0;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    if (scene.position[i].x() <= kBar - 0.9 * kFlyer) continue;
    mass += scene.mass[i];
    momentum += scene.mass[i] * state.velocity[i].x();
  }
  scenes::record_figure("spall of a bar: its speed over that of the flyer", momentum / mass / (1e3 * kSpeed), 3,
                        {1.0, 0.05});
}

/// A square of brittle beams in free flight that spins so fast that it breaks.
SceneSpec spinning_square() {
  constexpr double kSide = 20.0;
  constexpr double kSpin = 20000.0;  // rad/s
  FrameLattice frame = scenes::touching_beams({{0.0, 0.0}, {kSide, 0.0}, {kSide, kSide}, {0.0, kSide}},
                                              {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}, kThickness, 6);
  for (int i = 0; i < 4; ++i) {
    const double x = frame.nodes[i].x_mm - 0.5 * kSide;
    const double y = frame.nodes[i].y_mm - 0.5 * kSide;
    frame.initial_velocities.push_back({i, 1e-3 * -kSpin * y + 30.0, 1e-3 * kSpin * x, kSpin});
  }
  frame.end_time_s = 3e-4;
  return failing(frame, 0.005);
}

void expect_conservation(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  const auto mass_of = [](const Scene& scene) { return std::accumulate(scene.mass.begin(), scene.mass.end(), 0.0); };
  const double mass = mass_of(simulation.scene());
  const scenes::Momentum before = scenes::momentum_of(simulation.scene(), simulation.state());
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  EXPECT_GE(samples.back().break_count, 4);
  const scenes::Momentum after = scenes::momentum_of(simulation.scene(), simulation.state());
  EXPECT_NEAR(mass_of(simulation.scene()) / mass, 1.0, 1e-12);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-11 * before.linear.norm());
  const Energies& energies = samples.back().energies;
  EXPECT_LT(std::abs(energies.residual), 2e-3 * energies.initial);
  EXPECT_GT(energies.fracture, 0.0);
}

TEST(Fracture, FreeBodiesKeepMassMomentumAndEnergy) { expect_conservation(spinning_square()); }

TEST(Fracture, TheyDoSoWithRates) {
  SceneSpec spec = spinning_square();
  spec.material.cowper_symonds_rate_per_s = 6500.0;
  spec.material.cowper_symonds_exponent = 4.0;
  expect_conservation(spec);
}

/// A crush that breaks its walls.
SceneSpec brittle_crush() {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  spec.material.failure_strain = 0.02;
  spec.loading.end_strain = 0.15;
  return spec;
}

TEST(Fracture, ARunGoesOnFromACheckpointWithBrokenWalls) {
  const auto scene = scenes::build(brittle_crush());
  Simulation whole(scene);
  Simulation first(scene);
  const std::int64_t half = scene->schedule.step_count / 2;
  whole.advance(scene->schedule.step_count);
  first.advance(half);
  ASSERT_GT(first.state().breaks.size(), 0U);
  Simulation resumed(scene, 2);
  ASSERT_TRUE(resumed.restore(source_of(scenes::checkpoint_of(first))));
  EXPECT_EQ(scenes::hash_of(resumed.state()), scenes::hash_of(first.state()));
  resumed.advance(scene->schedule.step_count);
  EXPECT_GT(whole.state().breaks.size(), first.state().breaks.size());
  EXPECT_EQ(scenes::hash_of(resumed.state()), scenes::hash_of(whole.state()));
}

TEST(Fracture, ACrushHasTheSameBitsWithAnyNumberOfThreads) {
  const auto scene = scenes::build(brittle_crush());
  scenes::for_every_target([&] {
    std::map<int, std::uint64_t> hash_of_threads;
    for (const int threads : {1, 2, 3, 4}) {
      Simulation simulation(scene, threads);
      simulation.advance(scene->schedule.step_count);
      hash_of_threads[threads] = scenes::hash_of(simulation.state());
    }
    for (const auto& [threads, hash] : hash_of_threads) EXPECT_EQ(hash, hash_of_threads[1]) << threads << " threads";
  });
}

TEST(Fracture, FramesAddAParticleForEachBreak) {
  const auto scene = scenes::build(brittle_crush());
  Simulation simulation(scene);
  std::vector<Break> breaks;
  scenes::watch(simulation, [&](const Sample& sample) {
    breaks.insert(breaks.end(), sample.breaks.begin(), sample.breaks.end());
    EXPECT_EQ(sample.break_count, std::ssize(breaks));
  });
  const FieldFrame frame = simulation.take_frame(1);
  ASSERT_EQ(frame.position.size(), 2 * scene->particle_count());
  ASSERT_EQ(frame.broken_end.size(), breaks.size());
  ASSERT_EQ(frame.end_position.size(), 2 * breaks.size());
  // Each end is as far from the other end of its element as that is long.
  std::vector<int> nodes = mesh_of(*scene).element_nodes;
  std::vector<float> places = frame.position;
  places.insert(places.end(), frame.end_position.begin(), frame.end_position.end());
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    EXPECT_EQ(frame.broken_end[k], 2 * breaks[k].element + breaks[k].at_end);
    nodes[frame.broken_end[k]] = static_cast<int>(scene->particle_count() + k);
  }
  for (const Break& broken : breaks) {
    const auto place = [&](int end) { return Vector2(places[2 * nodes[end]], places[2 * nodes[end] + 1]); };
    const double length = (place(2 * broken.element + 1) - place(2 * broken.element)).norm();
    EXPECT_NEAR(length, simulation.state().length[broken.element], 1e-4);
  }
}

// With a failure strain that nothing reaches, a crush is the same but for the rounding of another law. Joints between
// units do not grow thicker, as those between walls, so that the area is constant here.
TEST(Fracture, UnitsOfWallsAreTheSameWalls) {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  spec.elements_per_wall = 4;
  spec.section.area_rule = SectionSpec::AreaRule::constant_area;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.contact.search = ContactSpec::Search::buckets;
  const auto whole = scenes::build(spec);
  spec.material.failure_strain = 10.0;
  const auto units = scenes::build(spec);
  EXPECT_NEAR(units->total_mass / whole->total_mass, 1.0, 1e-12);
  EXPECT_NEAR(units->stable_step / whole->stable_step, 1.0, 1e-12);
  EXPECT_NEAR(units->solid_area / whole->solid_area, 1.0, 1e-9);
  EXPECT_EQ(units->wall_count(), whole->wall_count());
  Simulation of_whole(whole);
  Simulation of_units(units);
  of_whole.advance(400);
  of_units.advance(400);
  const Sample expected = of_whole.take_sample();
  const Sample sample = of_units.take_sample();
  EXPECT_GT(expected.energies.plastic, 0.0);
  EXPECT_NEAR(sample.energies.plastic / expected.energies.plastic, 1.0, 1e-6);
  EXPECT_NEAR(sample.stress_impact / expected.stress_impact, 1.0, 1e-6);
  EXPECT_EQ(sample.break_count, 0);
}

// A rod is torn, its ends are drawn apart by two thicknesses and pushed together again.
TEST(Fracture, BrokenEndsTouchAgain) {
  FrameLattice frame = scenes::bar(kLength, kThickness, 8);
  frame.self_contact = true;
  frame.supports.push_back({0, true, true, true});
  frame.supports.push_back({1, false, true, true});
  frame.watched_nodes = {1};
  frame.end_time_s = 3e-3;
  frame.motions.push_back({1, Component::x, {{0.0, 0.0}, {1e-3, 3.0}, {2e-3, 1.5}, {3e-3, 0.0}}});
  SceneSpec spec = failing(frame, 0.2);
  double apart = 0.0;
  double together = 0.0;
  for (const Sample& sample : scenes::run_frame(spec)) {
    if (sample.break_count == 0) continue;
    const double gap = sample.watched[0].ux;
    if (gap > 1.5) apart = std::max(apart, static_cast<double>(sample.contact_count));
    if (gap < 0.5) together = std::min(together, sample.watched[0].reaction_x);
  }
  EXPECT_EQ(apart, 0.0);
  EXPECT_LT(together, -0.5 * kYield);  // N: compressed by at least half of its yield force
}

// What failure changes in a crush: at 10 m/s a brittle lattice bears a fraction of what one bears that cannot break, a
// ductile one nearly as much; at 100 m/s inertia bears most of the load, and debris as much as a lattice.
TEST(BrittleAndDuctile, PlateausOverThatOfALatticeThatCannotBreak) {
  for (const double speed : {10.0, 100.0}) {
    std::map<double, Summary> crushes;
    for (const double failure_strain : {0.0, 0.02, 0.3}) {
      SceneSpec spec = scenes::preset("brittle-lattice");
      spec.material.failure_strain = failure_strain;
      spec.loading.speed_m_per_s = speed;
      spec.loading.end_strain = 0.45;
      const auto scene = scenes::build(spec);
      Simulation simulation(scene);
      crushes[failure_strain] = summarize(*scene, scenes::run_to_end(simulation));
      EXPECT_LT(crushes[failure_strain].energy_error_relative, 0.02) << failure_strain << " at " << speed;
    }
    const std::string at = " at " + std::to_string(static_cast<int>(speed)) + " m/s";
    for (const auto& [failure_strain, name] : {std::pair(0.02, "brittle"), std::pair(0.3, "ductile")}) {
      const Summary& crush = crushes[failure_strain];
      scenes::record_figure(name + (" lattice: plateau over the unbreakable" + at),
                            *crush.plateau_stress_impact / *crushes[0.0].plateau_stress_impact, 2);
      scenes::record_figure(name + (" lattice: broken walls" + at), static_cast<double>(crush.break_count), 0);
    }
  }
}

TEST(Fracture, SidesThatRepeatAreRefused) {
  SceneSpec spec = brittle_crush();
  SceneSpec listed = scenes::as_network(spec);  // with failure in a material of its own
  auto& network = std::get<NetworkWalls>(listed.lattice);
  network.materials = {listed.material};
  network.wall_materials.assign(network.wall_count(), 1);
  listed.material.failure_strain = 0.0;
  for (SceneSpec* of : {&spec, &listed}) {
    of->loading.sides.kind = LoadingSpec::Sides::Kind::periodic;
    EXPECT_THAT(build_scene(*of).problems,
                ::testing::Contains(::testing::Field(&Problem::field, "material.failure_strain")));
  }
}

}  // namespace
}  // namespace cellcrush::fracture
