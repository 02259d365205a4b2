#include "core/scene/periodic_cell.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cellcrush {
namespace {

using Stiffness = Eigen::Matrix<double, 6, 6>;
using Ends = Eigen::Matrix<double, 6, 1>;

/// What yields of a beam. It keeps its force or moment from then on.
struct Yielded {
  bool axial = false;
  bool start = false;  // a plastic hinge
  bool end = false;

  bool operator==(const Yielded&) const = default;
};

/// Of a beam along its axis, with E = 1 and unit depth: along, across and rotation of its start, then of its end.
Stiffness local_stiffness_of(double length, double thickness, const Yielded& yielded) {
  const double axial = yielded.axial ? 0.0 : thickness / length;
  const double bending = thickness * thickness * thickness / 12.0 / (length * length * length);
  const double once = 6.0 * length * bending;
  const double twice = 2.0 * length * length * bending;
  Stiffness local;
  local << axial, 0.0, 0.0, -axial, 0.0, 0.0,                   //
      0.0, 12.0 * bending, once, 0.0, -12.0 * bending, once,    //
      0.0, once, 2.0 * twice, 0.0, -once, twice,                //
      -axial, 0.0, 0.0, axial, 0.0, 0.0,                        //
      0.0, -12.0 * bending, -once, 0.0, 12.0 * bending, -once,  //
      0.0, once, twice, 0.0, -once, 2.0 * twice;
  for (const int turn : {2, 5}) {
    if (!(turn == 2 ? yielded.start : yielded.end)) continue;
    const double own = local(turn, turn);
    if (own > 1e-12 * twice) local -= (local.col(turn) * local.row(turn) / own).eval();
    local.row(turn).setZero();
    local.col(turn).setZero();
  }
  return local;
}

/// The forces on the ends of a beam along its axis, of what its cell does: motions of the nodes, and the strains along
/// x and y and the shear, with which the ends move besides.
class BeamInCell {
 public:
  explicit BeamInCell(const UnitCell::Beam& beam)
      : beam_(beam), length_(beam.along.norm()), local_(local_stiffness_of(length_, beam.thickness, {})) {
    const Vector2 unit = beam.along / length_;
    for (const int i : {0, 3}) turn_.block<2, 2>(i, i) << unit.x(), unit.y(), -unit.y(), unit.x();
    moved_.row(3) << beam.along.x(), 0.0, 0.5 * beam.along.y();
    moved_.row(4) << 0.0, beam.along.y(), 0.5 * beam.along.x();
  }

  void yield(const Yielded& yielded) { local_ = local_stiffness_of(length_, beam_.thickness, yielded); }

  /// Rows and columns: the nodes' motions, then the strains.
  void add_to(Eigen::MatrixXd& matrix) const {
    const Stiffness stiffness = turn_.transpose() * local_ * turn_;
    const int strains = static_cast<int>(matrix.rows()) - 3;
    const Eigen::Matrix<double, 6, 3> forces = stiffness * moved_;
    matrix.bottomRightCorner<3, 3>() += moved_.transpose() * forces;
    for (int i = 0; i < 6; ++i) {
      matrix.block<1, 3>(row_of(i), strains) += forces.row(i);
      matrix.block<3, 1>(strains, row_of(i)) += forces.row(i).transpose();
      for (int j = 0; j < 6; ++j) matrix(row_of(i), row_of(j)) += stiffness(i, j);
    }
  }

  [[nodiscard]] Ends forces(const Eigen::VectorXd& motion) const {
    Ends ends = moved_ * motion.tail<3>();
    for (int i = 0; i < 6; ++i) ends[i] += motion[row_of(i)];
    return local_ * (turn_ * ends);
  }

  [[nodiscard]] double bending_stiffness() const { return std::pow(beam_.thickness, 3) / length_; }
  [[nodiscard]] double yield_force() const { return beam_.thickness; }  // of a yield stress of 1
  [[nodiscard]] double yield_moment() const { return 0.25 * beam_.thickness * beam_.thickness; }
  [[nodiscard]] const UnitCell::Beam& beam() const { return beam_; }

 private:
  [[nodiscard]] int row_of(int i) const { return 3 * (i < 3 ? beam_.start : beam_.end) + i % 3; }

  UnitCell::Beam beam_;
  double length_;
  Stiffness local_;
  Stiffness turn_ = Stiffness::Identity();
  Eigen::Matrix<double, 6, 3> moved_ = Eigen::Matrix<double, 6, 3>::Zero();
};

/// Motions of the nodes and strains under a unit stress along an axis. The first node stays where it is. `joints`:
/// stiffness of each node against turning, over that of its beams, so that one of hinges alone has a place.
Eigen::VectorXd press(const UnitCell& cell, const std::vector<BeamInCell>& beams, int axis, double joints) {
  const int count = 3 * cell.nodes;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + 3, count + 3);
  for (const BeamInCell& beam : beams) {
    beam.add_to(matrix);
    for (const int node : {beam.beam().start, beam.beam().end})
      matrix(3 * node + 2, 3 * node + 2) += joints * beam.bending_stiffness();
  }
  const int free = count + 1;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(free);
  load[count - 2 + axis] = cell.area;
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(count + 3);
  motion.tail(free) = matrix.bottomRightCorner(free, free).ldlt().solve(load);
  return motion;
}

std::vector<BeamInCell> beams_of(const UnitCell& cell) { return {cell.beams.begin(), cell.beams.end()}; }

/// What a beam bears, and what of it has yielded.
struct Borne {
  double axial = 0.0;
  double start = 0.0;
  double end = 0.0;
  Yielded yielded;
};

}  // namespace

CellModuli solve_periodic_cell(const UnitCell& cell, int axis) {
  if (cell.area == 0.0) return {};
  const Eigen::VectorXd motion = press(cell, beams_of(cell), axis, 0.0);
  const Eigen::Vector3d strain = motion.tail<3>();
  return {1.0 / strain[axis], -strain[1 - axis] / strain[axis]};
}

double collapse_stress_of_periodic_cell(const UnitCell& cell, int axis) {
  if (cell.area == 0.0) return 0.0;
  constexpr double kJoints = 1e-9;
  constexpr double kCollapsed = 1e-3;  // of the stiffness before
  std::vector<BeamInCell> beams = beams_of(cell);
  std::vector<Borne> borne(beams.size());
  double stress = 0.0;
  double elastic = 0.0;  // strain of a unit stress
  for (std::size_t yields = 0; yields <= 3 * beams.size(); ++yields) {
    const Eigen::VectorXd motion = press(cell, beams, axis, kJoints);
    const double strain = std::abs(motion.tail<3>()[axis]);
    elastic = yields == 0 ? strain : elastic;
    // Of a matrix that is singular Eigen leaves out the mode; no strain is less than the elastic one otherwise.
    if (!(kCollapsed * strain < elastic && strain > 0.99 * elastic)) return stress;
    double rise = std::numeric_limits<double>::infinity();  // of the stress, until the next yields
    std::size_t next = 0;
    Yielded then;
    for (std::size_t i = 0; i < beams.size(); ++i) {
      const Ends forces = beams[i].forces(motion);
      const auto look = [&](double its, double change, double most, bool Yielded::*part) {
        if (borne[i].yielded.*part || std::abs(change) * elastic < 1e-12 * most) return;
        const double left = ((change > 0.0 ? most : -most) - its) / change;
        if (left >= rise) return;
        rise = left;
        next = i;
        then = borne[i].yielded;
        then.*part = true;
      };
      look(borne[i].axial, forces[3], beams[i].yield_force(), &Yielded::axial);
      look(borne[i].start, forces[2], beams[i].yield_moment(), &Yielded::start);
      look(borne[i].end, forces[5], beams[i].yield_moment(), &Yielded::end);
    }
    rise = std::max(0.0, rise);
    stress += rise;
    for (std::size_t i = 0; i < beams.size(); ++i) {
      const Ends forces = beams[i].forces(motion);
      borne[i].axial += rise * forces[3];
      borne[i].start += rise * forces[2];
      borne[i].end += rise * forces[5];
    }
    borne[next].yielded = then;
    beams[next].yield(then);
  }
  return 0.0;
}

}  // namespace cellcrush
