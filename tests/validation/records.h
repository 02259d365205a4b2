#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"

namespace cellcrush::validation {

/// Writes a curve as it comes, a row a sample: strain, the plate's travel in mm, the plates' stresses in MPa, the
/// energies in N mm, with six digits.
class CurveFile {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  explicit CurveFile(const std::string& file);
  void add(Sample sample);

 private:
  std::ofstream stream_;
};

/// The samples of such a file, with what stands in it; a last row that was cut short is left out. Throws
/// std::runtime_error when the file is missing or has other columns.
std::vector<Sample> read_curve(const std::string& file);

// Frames of a crush, kept so that pictures can be drawn of it later: the mesh and then the frames one after another, as
// bits of the machine that wrote them.

/// Writes frames as they come, so that those of a run that is cut short are there.
class FramesFile {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  FramesFile(const std::string& file, const MeshView& mesh);
  void add(const FieldFrame& frame);

 private:
  std::ofstream stream_;
};

struct KeptFrames {
  MeshView mesh;
  std::vector<FieldFrame> frames;  ///< by strain; those that are in the file as a whole
};

/// Throws std::runtime_error when the file is missing or is none that FramesFile wrote.
KeptFrames read_frames(const std::string& file);

}  // namespace cellcrush::validation
