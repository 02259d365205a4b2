#pragma once

namespace cellcrush::reference {

/// Bilinear law with mixed hardening. MPa.
struct Material {
  double modulus = 0.0;             ///< E
  double yield_stress = 0.0;        ///< sigma_y
  double hardening_modulus = 0.0;   ///< H
  double isotropic_fraction = 1.0;  ///< beta
  double density = 0.0;             ///< rho, tonne / mm^3
  bool plane_strain = false;        ///< otherwise plane stress
};

/// History of a fibre. MPa.
struct Fibre {
  double stress = 0.0;          ///< sigma
  double back_stress = 0.0;     ///< alpha
  double plastic_strain = 0.0;  ///< ep, accumulated
};

/// What a fibre does in a step.
struct Flow {
  double strain = 0.0;  ///< plastic strain increment, with its sign
  double work = 0.0;    ///< plastic work, MPa: over the mean of the stresses at which the flow begins and ends (E10)
};

/// Return mapping of a fibre under a strain increment (Eq. 33-39).
Flow return_fibre(const Material& material, double strain_increment, Fibre& fibre);

}  // namespace cellcrush::reference
