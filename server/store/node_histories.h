#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// Datasets of a watched node.
inline constexpr std::size_t kNodeColumnCount = 6;

/// Writes /nodes/{id}/{ux_mm, uy_mm, rotation_rad, reaction_x_n, reaction_y_n, reaction_moment_n_mm} of a result: the
/// motion and the reactions of a frame's watched nodes, one row per sample, parallel to /history. Writes nothing
/// without watched nodes. Failures throw ServiceError.
class NodeHistories {
 public:
  /// Appends the rows of samples with the same watched nodes. `file` is the open result.
  void append(hid_t file, std::span<const v1::Sample> samples);
  void close();

 private:
  struct Node {
    Hdf5Handle group;
    std::array<Hdf5Handle, kNodeColumnCount> columns;
  };

  void make_nodes(hid_t file, const v1::Sample& sample);

  Hdf5Handle nodes_;
  std::vector<Node> written_;
};

}  // namespace cellcrush::store
