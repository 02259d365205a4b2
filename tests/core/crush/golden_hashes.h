#pragma once

#include <map>
#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A crush of which the bits are recorded.
struct GoldenCrush {
  std::string name;
  SceneSpec spec;
  int steps = 0;  ///< 0 for all
};

/// The first 500 steps of every preset.
std::vector<GoldenCrush> first_steps_of_presets();

/// Small specimens crushed to 60 %: lattices, rules, precisions, hardening, friction, damping, rigid cells, two
/// thicknesses.
std::vector<GoldenCrush> whole_crushes();

using Hashes = std::map<std::string, std::string>;  ///< of "crush,target"

/// The hashes of the file CELLCRUSH_GOLDEN_HASHES.
Hashes read_hashes();
void write_hashes(const Hashes& hashes);

/// The hashes of crushes on every target of this processor.
Hashes hashes_of(const std::vector<GoldenCrush>& crushes);

/// Whether the file's bits are those of this processor. The C library's sine, and with it the mesh, rounds otherwise
/// where fused multiply-add is missing.
bool is_processor_of_the_file();

}  // namespace cellcrush::scenes
