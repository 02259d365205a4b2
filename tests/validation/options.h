#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush::validation {

/// What the program is asked to do: a preset, changed by `name=value` words, and where to write.
struct Options {
  SceneSpec spec;
  std::string preset;
  std::string changes;       ///< the words that changed the preset, as given, separated by blanks
  double step_factor = 1.0;  ///< by which the step was made another; done in `spec`
  double until = std::numeric_limits<double>::infinity();  ///< strain at which the run is broken off
  std::string simd_target;                                 ///< kernel to use; empty: the best
  std::string table_file;                                  ///< CSV to which a row is appended; empty: none
  std::string curve_file;                                  ///< CSV of the curve; empty: none
  std::string frames_file;                                 ///< of the lattice's frames (frames_file.h); empty: none
};

/// Reads `preset [name=value ...]`. Throws std::invalid_argument, with what was found and what is allowed, on an
/// unknown preset, name or value.
Options read_options(const std::vector<std::string>& words);

/// All names that read_options takes, with what they mean, a line each.
std::string describe_options();

}  // namespace cellcrush::validation
