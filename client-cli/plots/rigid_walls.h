#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "chart/lattice_drawing.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// The rigid walls of a case, moved by the displacements of the samples of its run.
class RigidWalls {
 public:
  struct Start {
    WallFace face;
    bool at_edge = false;  ///< counted from the outermost surface of the lattice
  };

  RigidWalls() = default;
  RigidWalls(const v1::Case& submitted, std::vector<v1::Sample> samples);

  /// The faces at a time; before the first sample those at the start. Empty without rigid walls. `mesh`: of the case.
  [[nodiscard]] std::vector<WallFace> at(double time_s, const v1::Mesh& mesh) const;

 private:
  std::vector<Start> start_;
  std::vector<v1::Sample> samples_;  ///< times ascending
};

/// Those of a job; fetches its samples only if it has any. Throws CommandError.
RigidWalls fetch_rigid_walls(Connection& connection, const std::string& job);

}  // namespace cellcrush::client
