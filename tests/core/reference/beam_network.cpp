#include "core/reference/beam_network.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

namespace cellcrush::reference {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Stiffness of a beam for the displacements and rotations of its ends.
Matrix6 stiffness_of(double x, double y, double thickness) {
  const double length = std::hypot(x, y);
  const double axial = thickness / length;
  const double bending = thickness * thickness * thickness / (12.0 * length * length * length);
  Matrix6 local = Matrix6::Zero();
  local(0, 0) = local(3, 3) = axial;
  local(0, 3) = local(3, 0) = -axial;
  const double shear = 12.0 * bending;
  const double arm = 6.0 * bending * length;
  const double turn = 4.0 * bending * length * length;
  local(1, 1) = local(4, 4) = shear;
  local(1, 4) = local(4, 1) = -shear;
  local(1, 2) = local(2, 1) = local(1, 5) = local(5, 1) = arm;
  local(2, 4) = local(4, 2) = local(4, 5) = local(5, 4) = -arm;
  local(2, 2) = local(5, 5) = turn;
  local(2, 5) = local(5, 2) = 0.5 * turn;
  Matrix6 rotation = Matrix6::Identity();
  for (const int at : {0, 3}) {
    rotation(at, at) = rotation(at + 1, at + 1) = x / length;
    rotation(at, at + 1) = y / length;
    rotation(at + 1, at) = -y / length;
  }
  return rotation.transpose() * local * rotation;
}

}  // namespace

double modulus_between_plates(const BeamNetwork& network, int axis) {
  const auto size = static_cast<Eigen::Index>(3 * network.joints.size());
  const auto along = [&](std::size_t joint, int of_axis) { return network.joints[joint][of_axis]; };
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  for (const int each : {0, 1}) {
    const auto [least, most] =
        std::ranges::minmax(network.joints, {}, [each](const auto& joint) { return joint[each]; });
    low[each] = least[each];
    high[each] = most[each];
  }
  const double near = 1e-9 * (high[axis] - low[axis]);
  // The plate at the low end stands; that at the high end moves by -1.
  Eigen::VectorXd imposed = Eigen::VectorXd::Zero(size);
  std::vector<char> is_held(size, 0);
  bool is_anchored = false;
  for (std::size_t joint = 0; joint < network.joints.size(); ++joint) {
    const bool at_low = along(joint, axis) < low[axis] + near;
    const bool at_high = along(joint, axis) > high[axis] - near;
    if (at_low || at_high) is_held[3 * joint + axis] = 1;
    if (at_high) imposed[static_cast<Eigen::Index>(3 * joint + axis)] = -1.0;
    if (at_low && !is_anchored) is_held[3 * joint + 1 - axis] = 1;
    is_anchored = is_anchored || at_low;
  }
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Eigen::Triplet<double>> free_entries;
  for (const BeamNetwork::Wall& wall : network.walls) {
    const Matrix6 stiffness = stiffness_of(along(wall.end, 0) - along(wall.start, 0),
                                           along(wall.end, 1) - along(wall.start, 1), wall.thickness);
    const auto index = [&](int i) { return 3 * (i < 3 ? wall.start : wall.end) + i % 3; };
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        entries.emplace_back(index(i), index(j), stiffness(i, j));
        if (is_held[index(i)] == 0 && is_held[index(j)] == 0) {
          free_entries.emplace_back(index(i), index(j), stiffness(i, j));
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    if (is_held[i] != 0) free_entries.emplace_back(i, i, 1.0);
  }
  Eigen::SparseMatrix<double> whole(size, size);
  whole.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> free(size, size);
  free.setFromTriplets(free_entries.begin(), free_entries.end());
  Eigen::VectorXd load = -(whole * imposed);
  for (Eigen::Index i = 0; i < size; ++i) {
    if (is_held[i] != 0) load[i] = 0.0;
  }
  const Eigen::VectorXd moved =
      imposed + Eigen::VectorXd(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(free).solve(load));
  const Eigen::VectorXd force = whole * moved;
  double reaction = 0.0;
  for (std::size_t joint = 0; joint < network.joints.size(); ++joint) {
    if (along(joint, axis) > high[axis] - near) reaction -= force[static_cast<Eigen::Index>(3 * joint + axis)];
  }
  const double length = high[axis] - low[axis];
  const double width = high[1 - axis] - low[1 - axis];
  return reaction / width * length;
}

}  // namespace cellcrush::reference
