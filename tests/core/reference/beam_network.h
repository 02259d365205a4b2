#pragma once

#include <array>
#include <vector>

namespace cellcrush::reference {

/// Straight beams of unit depth and modulus, rigidly joined.
struct BeamNetwork {
  struct Wall {
    int start = 0;
    int end = 0;
    double thickness = 0.0;
  };
  std::vector<std::array<double, 2>> joints;
  std::vector<Wall> walls;
  /// E / (kappa G) of beams that shear (Timoshenko); 0: they do not (Euler-Bernoulli).
  double shear_flexibility = 0.0;
};

/// Stress over strain, in units of the modulus of the beams, of a network between two rigid plates without friction
/// across an axis (0: x): the joints that are lowest and highest along it move with the plates, and stay free along
/// them. By the stiffness of its beams and of the displacements of its joints, small ones.
double modulus_between_plates(const BeamNetwork& network, int axis);

/// Force of two grips along y over their approach, over the modulus: joints at `low` and below stand still, those at
/// `high` and above move along y. None of them turns or moves along x. Small displacements, too.
double stiffness_between_grips(const BeamNetwork& network, double low, double high);

}  // namespace cellcrush::reference
