#include "core/crush/golden_hashes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/presets.h"
#include "scenes/small_specimen.h"
#include "scenes/state_hash.h"

namespace cellcrush::scenes {
namespace {

/// Seven columns and five rows leave some walls over after whole vectors.
SceneSpec specimen(const char* lattice, double friction = 0.0) {
  SceneSpec spec = spec_of({lattice, 100.0, friction}, 7, 5);
  spec.loading.end_strain = 0.6;
  return spec;
}

SceneSpec with_hardening(SceneSpec spec, double isotropic_fraction) {
  spec.material.hardening_modulus_mpa = 700.0;
  spec.material.isotropic_fraction = isotropic_fraction;
  spec.numerics.mass_damping_per_s = 1000.0;
  return spec;
}

SceneSpec in_single_precision(SceneSpec spec) {
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::single_precision;
  return spec;
}

SceneSpec with_elements_per_wall(SceneSpec spec, int elements) {
  spec.elements_per_wall = elements;
  return spec;
}

SceneSpec with_a_rigid_row(SceneSpec spec) {
  spec.inclusions.rows = {2};
  return spec;
}

std::string hash_of_crush(const GoldenCrush& crush) {
  Simulation simulation(build(crush.spec));
  simulation.advance(crush.steps > 0 ? crush.steps : simulation.scene().schedule.step_count);
  std::ostringstream hash;
  hash << std::hex << std::setw(16) << std::setfill('0') << hash_of(simulation.state());
  return hash.str();
}

}  // namespace

std::vector<GoldenCrush> first_steps_of_presets() {
  std::vector<GoldenCrush> crushes;
  for (const auto& preset : scenes::presets()) {
    crushes.push_back({preset.name, preset.spec, 500});
  }
  return crushes;
}

std::vector<GoldenCrush> whole_crushes() {
  return {{"hexagons", specimen("hexagon", 0.2)},
          {"squares", specimen("square")},
          {"triangles", specimen("triangle", 0.2)},
          {"thick ends", specimen("thick_ends")},
          {"hexagons of the paper's elements", with_the_papers_elements(specimen("hexagon"))},
          {"squares of the paper's elements",
           with_elements_per_wall(in_single_precision(with_the_papers_elements(specimen("square", 0.2))), 2)},
          {"hexagons in single precision", in_single_precision(specimen("hexagon"))},
          {"mixed hardening and damping", with_hardening(specimen("hexagon", 0.2), 0.5)},
          {"kinematic hardening", with_hardening(with_the_papers_elements(specimen("hexagon")), 0.0)},
          {"one element a wall", with_elements_per_wall(specimen("triangle"), 1)},
          {"five elements a wall", with_elements_per_wall(specimen("hexagon"), 5)},
          {"a rigid row", with_a_rigid_row(specimen("hexagon"))}};
}

Hashes read_hashes() {
  std::ifstream file(CELLCRUSH_GOLDEN_HASHES);
  Hashes hashes;
  std::string line;
  std::getline(file, line);  // the names of the columns
  while (std::getline(file, line)) {
    const std::size_t comma = line.rfind(',');
    hashes[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return hashes;
}

void write_hashes(const Hashes& hashes) {
  std::ofstream file(CELLCRUSH_GOLDEN_HASHES);
  file << "crush,target,hash\n";
  for (const auto& [key, hash] : hashes) {
    file << key << "," << hash << "\n";
  }
}

Hashes hashes_of(const std::vector<GoldenCrush>& crushes) {
  Hashes hashes;
  for (const std::string& target : simd_targets()) {
    EXPECT_TRUE(use_simd_target(target));
    for (const GoldenCrush& crush : crushes) {
      hashes[crush.name + "," + target] = hash_of_crush(crush);
    }
  }
  EXPECT_TRUE(use_simd_target(""));
  return hashes;
}

bool is_processor_of_the_file() {
  const std::vector<std::string> targets = simd_targets();
  return std::find(targets.begin(), targets.end(), "avx2") != targets.end();
}

}  // namespace cellcrush::scenes
