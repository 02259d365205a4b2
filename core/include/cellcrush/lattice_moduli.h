#pragma once

#include <optional>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// What an endless lattice of elastic Euler-Bernoulli beams answers to a stress along one axis.
struct ElasticModuli {
  double modulus = 0.0;         ///< E*, MPa
  double poissons_ratio = 0.0;  ///< nu*, of the strain across
};

struct LatticeModuli {
  ElasticModuli along;   ///< along the crush
  ElasticModuli across;  ///< and across it
};

/// Those of the lattice of equal cells of a spec, whose walls nothing changes and which do not shear. Empty for any
/// other spec, of which they are not known. REQUIRES: a spec without problems.
std::optional<LatticeModuli> elastic_moduli_of(const SceneSpec& spec);

}  // namespace cellcrush
