#pragma once

#include <span>
#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// A number of a part of a frame, of which a sample has several.
struct PartColumn {
  const char* name;
  double (*get)(const v1::Sample& sample, int part);
};

/// Parts of a frame whose numbers samples have.
struct PartKind {
  const char* group;  ///< of the result, with a group for each part
  int (*count)(const v1::Sample& sample);
  std::string (*id)(const v1::Sample& sample, int part);
  std::span<const PartColumn> columns;
};

/// /nodes/{id}/{ux_mm, uy_mm, rotation_rad, reaction_x_n, reaction_y_n, reaction_moment_n_mm}: watched nodes.
extern const PartKind kWatchedNodes;
/// /rigid_walls/{id}/{displacement_mm, normal_force_n, tangential_force_n}.
extern const PartKind kRigidWalls;

/// Writes the numbers of the parts of a frame to a result, a dataset for each number of each part, with one row per
/// sample, parallel to /history. Writes nothing without such parts. Failures throw ServiceError.
class PartHistories {
 public:
  explicit PartHistories(const PartKind& kind) : kind_(kind) {}

  /// Appends the rows of samples with the same parts. `file` is the open result.
  void append(hid_t file, std::span<const v1::Sample> samples);
  void close();

 private:
  struct Part {
    Hdf5Handle group;
    std::vector<Hdf5Handle> columns;
  };

  void make_parts(hid_t file, const v1::Sample& sample);

  const PartKind& kind_;
  Hdf5Handle all_;
  std::vector<Part> written_;
};

}  // namespace cellcrush::store
