#include "cellcrush/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

/// Crushes for 1000 steps with a kernel, then goes back to the best one.
State crush(const SceneSpec& spec, const std::string& target, int steps = 1000) {
  EXPECT_TRUE(use_simd_target(target)) << target;
  Simulation simulation(scenes::build(spec));
  simulation.advance(steps);
  EXPECT_TRUE(use_simd_target(""));
  return simulation.state();
}

/// Greatest distance between the same particles, mm.
double distance_between(const State& one, const State& other) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < one.position.size(); ++i) {
    greatest = std::max(greatest, (one.position[i] - other.position[i]).norm());
  }
  return greatest;
}

SceneSpec in_double_precision(SceneSpec spec) {
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  return spec;
}

/// Specimens with an odd number of walls, so that some are advanced side by side and some alone.
SceneSpec specimen(int elements) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.elements_per_wall = elements;
  spec.imperfection = {0.01, 1};
  return in_double_precision(spec);
}

SceneSpec with_friction_and_hardening(SceneSpec spec) {
  spec.contact.friction = 0.2;
  spec.plates.friction = 0.2;
  spec.material.hardening_modulus_mpa = 700.0;
  spec.material.isotropic_fraction = 0.5;
  spec.numerics.mass_damping_per_s = 1000.0;
  return spec;
}

SceneSpec in_single_precision(SceneSpec spec) {
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::single_precision;
  return spec;
}

SceneSpec squares() {
  SceneSpec spec = scenes::preset("type-ii-as-counted");
  auto& lattice = scenes::cells_of(spec);
  lattice.columns = 9;
  lattice.rows = 5;
  return in_double_precision(spec);
}

struct Compared {
  const char* name;
  SceneSpec spec;
  int steps;        ///< over which the same motion is asked for
  double distance;  ///< mm, between the same particles
};

// Vectors return fibres of single precision in single precision, the reference in double: it rounds what is remembered.
// Force-based elements decide by thresholds whether a section turns back and whether it is in balance enough; a last
// bit may turn such a decision, as it may where walls touch. Their motions part sooner.
std::vector<Compared> scenes_to_compare() {
  return {{"paper", scenes::with_the_papers_elements(specimen(2)), 1000, 1e-7},
          {"one element a wall", scenes::with_the_papers_elements(specimen(1)), 1000, 4e-6},
          {"paper, hardening, friction, damping",
           with_friction_and_hardening(scenes::with_the_papers_elements(specimen(2))), 1000, 1e-7},
          {"paper, single precision", in_single_precision(scenes::with_the_papers_elements(specimen(2))), 1000, 4e-3},
          {"default, single precision", in_single_precision(specimen(2)), 60, 1e-3},
          {"default", specimen(2), 60, 1e-7},
          {"four elements a wall", specimen(4), 60, 1e-7},
          {"hardening, friction, damping", with_friction_and_hardening(specimen(2)), 60, 1e-7},
          {"squares", squares(), 60, 1e-7}};
}

std::string distance_name(const SceneSpec& spec) {
  if (spec.numerics.fibre_precision == NumericsSpec::FibrePrecision::double_precision) return "double precision";
  const bool force_based = spec.section.formulation == SectionSpec::Formulation::force_based;
  return force_based ? "single precision" : "single precision with the paper's elements";
}

TEST(Simd, EveryTargetMovesTheParticlesAsTheReferenceDoes) {
  for (const auto& [name, spec, steps, bound] : scenes_to_compare()) {
    const State reference = crush(spec, "scalar", steps);
    ASSERT_GT(reference.ledger.plastic, 0.0) << name;
    for (const std::string& target : simd_targets()) {
      const State wide = crush(spec, target, steps);
      const double distance = distance_between(reference, wide);
      EXPECT_LT(distance, bound) << name << ", " << target;
      scenes::record_bound(distance_name(spec) + " in mm", distance);
      EXPECT_EQ(wide.fibres.yielded, reference.fibres.yielded) << name << ", " << target;
    }
  }
}

TEST(Simd, EveryTargetDoesTheWorkOfTheReferenceOverAThousandSteps) {
  for (const auto& [name, spec, steps, bound] : scenes_to_compare()) {
    const Ledger reference = crush(spec, "scalar").ledger;
    for (const std::string& target : simd_targets()) {
      const Ledger wide = crush(spec, target).ledger;
      EXPECT_NEAR(wide.external, reference.external, 0.01 * reference.external) << name << ", " << target;
      EXPECT_NEAR(wide.plastic, reference.plastic, 0.01 * reference.external) << name << ", " << target;
      EXPECT_NEAR(wide.contact_damping, reference.contact_damping, 0.01 * reference.external) << name << ", " << target;
      const double worst =
          std::max({std::abs(wide.external - reference.external), std::abs(wide.plastic - reference.plastic),
                    std::abs(wide.contact_damping - reference.contact_damping)});
      scenes::record_bound("work difference in %", 100.0 * worst / reference.external);
    }
  }
}

TEST(Simd, VectorTargetsWithFusedMultiplyAddGiveTheSameBits) {
  const std::vector<std::string> targets = simd_targets();
  const auto has = [&](const char* name) { return std::find(targets.begin(), targets.end(), name) != targets.end(); };
  if (!has("avx2") || !has("avx512")) {
    GTEST_SKIP() << "This processor has no AVX-512.";
  }
  for (const auto& [name, spec, steps, bound] : scenes_to_compare()) {
    EXPECT_EQ(scenes::hash_of(crush(spec, "avx2")), scenes::hash_of(crush(spec, "avx512"))) << name;
  }
}

/// A crushed state, of walls of two materials, every fifth element compressed so short that its modulus is bounded.
struct Compressed {
  Scene scene;
  State state;
};

Compressed squash(const SceneSpec& spec) {
  Compressed out{*scenes::build(spec), crush(spec, "scalar", 500)};
  out.scene.materials.push_back(out.scene.materials.front());
  out.scene.materials.back().youngs_modulus *= 0.25;
  for (std::size_t wall = 0; wall < out.scene.walls.material.size(); wall += 3) {
    out.scene.walls.material[wall] = 1;
  }
  for (std::size_t e = 0; e < out.state.length.size(); e += 5) {
    out.state.length[e] *= 0.5;
  }
  return out;
}

TEST(Simd, EveryTargetFindsTheEnergiesOfTheReference) {
  for (const auto& [name, spec, steps, bound] : scenes_to_compare()) {
    const Compressed compressed = squash(spec);
    const auto energies_by = [&](const std::string& target) {
      EXPECT_TRUE(use_simd_target(target));
      return evaluate_energies(compressed.scene, compressed.state);
    };
    const double tolerance = compressed.scene.single_fibres ? 1e-6 : 1e-12;  // single precision squares its stresses
    const Energies reference = energies_by("scalar");
    ASSERT_GT(reference.elastic, 0.0) << name;
    for (const std::string& target : simd_targets()) {
      const Energies wide = energies_by(target);
      EXPECT_NEAR(wide.elastic / reference.elastic, 1.0, tolerance) << name << ", " << target;
      EXPECT_NEAR(wide.kinetic / reference.kinetic, 1.0, 1e-12) << name << ", " << target;
      EXPECT_NEAR(wide.external / reference.external, 1.0, 1e-12) << name << ", " << target;
    }
  }
  EXPECT_TRUE(use_simd_target(""));
}

TEST(Simd, AnUnknownTargetIsRefusedAndChangesNothing) {
  const std::string before = simd_target();
  EXPECT_FALSE(use_simd_target("abacus"));
  EXPECT_EQ(simd_target(), before);
  EXPECT_EQ(simd_targets().back(), "scalar");
}

}  // namespace
}  // namespace cellcrush
