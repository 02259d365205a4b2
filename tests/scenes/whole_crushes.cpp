#include "scenes/whole_crushes.h"

#include "scenes/crushes.h"
#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

SceneSpec with_hardening(SceneSpec spec, double isotropic_fraction) {
  spec.material.hardening_modulus_mpa = 700.0;
  spec.material.isotropic_fraction = isotropic_fraction;
  spec.numerics.mass_damping_per_s = 1000.0;
  return spec;
}

SceneSpec with_a_curve_and_a_rate(SceneSpec spec) {
  spec.material.voce_stress_mpa = 50.0;
  spec.material.voce_exponent = 20.0;
  spec.material.isotropic_fraction = 0.5;
  spec.material.cowper_symonds_rate_per_s = 6500.0;
  spec.material.cowper_symonds_exponent = 4.0;
  return spec;
}

SceneSpec with_elements_per_wall(SceneSpec spec, int elements) {
  spec.elements_per_wall = elements;
  return spec;
}

SceneSpec with_shear(SceneSpec spec) {
  spec.section.shear_deformation = true;
  return spec;
}

SceneSpec with_coupled_bending(SceneSpec spec) {
  spec.section.coupled_bending = true;
  return spec;
}

SceneSpec with_a_rigid_row(SceneSpec spec) {
  spec.inclusions.rows = {2};
  return spec;
}

}  // namespace

SceneSpec whole_specimen(const char* lattice, double friction) {
  SceneSpec spec = spec_of({lattice, 100.0, friction}, 7, 5);
  spec.loading.end_strain = 0.6;
  return spec;
}

std::vector<WholeCrush> whole_crushes() {
  return {{"hexagons", whole_specimen("hexagon", 0.2)},
          {"squares", whole_specimen("square")},
          {"triangles", whole_specimen("triangle", 0.2)},
          {"thick ends", whole_specimen("thick_ends")},
          {"hexagons of the paper's elements", with_the_papers_elements(whole_specimen("hexagon"))},
          {"squares of the paper's elements",
           with_elements_per_wall(in_single_precision(with_the_papers_elements(whole_specimen("square", 0.2))), 2)},
          {"hexagons in single precision", in_single_precision(whole_specimen("hexagon"))},
          {"mixed hardening and damping", with_hardening(whole_specimen("hexagon", 0.2), 0.5)},
          {"kinematic hardening", with_hardening(with_the_papers_elements(whole_specimen("hexagon")), 0.0)},
          {"a curve and a rate", with_a_curve_and_a_rate(whole_specimen("hexagon", 0.2))},
          {"a curve and a rate in the paper's elements",
           with_a_curve_and_a_rate(with_the_papers_elements(whole_specimen("hexagon")))},
          {"one element a wall", with_elements_per_wall(whole_specimen("triangle"), 1)},
          {"five elements a wall", with_elements_per_wall(whole_specimen("hexagon"), 5)},
          {"a rigid row", with_a_rigid_row(whole_specimen("hexagon"))},
          {"walls that shear", with_shear(whole_specimen("hexagon"))},
          {"coupled bending", with_coupled_bending(whole_specimen("hexagon"))}};
}

}  // namespace cellcrush::scenes
