#include "server/small_case.h"

namespace cellcrush::testing {

v1::Case small_case() {
  v1::Case out;
  out.set_title("A few cells");
  auto& hexagon = *out.mutable_lattice()->mutable_hexagon();
  hexagon.set_columns(6);
  hexagon.set_rows(5);
  hexagon.set_side_mm(4.0);
  hexagon.set_wall_thickness_mm(0.3464);
  out.set_depth_mm(4.0);
  out.mutable_material()->set_youngs_modulus_mpa(69000.0);
  out.mutable_material()->set_yield_stress_mpa(76.0);
  out.mutable_material()->set_density_kg_per_m3(2700.0);
  out.mutable_loading()->set_speed_m_per_s(100.0);
  out.mutable_loading()->set_end_strain(0.5);
  out.mutable_output()->set_sample_count(100);
  out.mutable_output()->set_frame_count(10);
  return out;
}

v1::Case tiny_case() {
  v1::Case out = small_case();
  out.mutable_lattice()->mutable_hexagon()->set_columns(4);
  out.mutable_lattice()->mutable_hexagon()->set_rows(3);
  out.mutable_loading()->set_end_strain(0.3);
  out.mutable_output()->set_sample_count(20);
  out.mutable_output()->set_frame_count(2);
  return out;
}

v1::Case case_of_seconds() {
  v1::Case out = small_case();
  out.mutable_lattice()->mutable_hexagon()->set_columns(12);
  out.mutable_lattice()->mutable_hexagon()->set_rows(8);
  out.mutable_loading()->set_speed_m_per_s(5.0);
  out.mutable_output()->set_sample_count(200);
  out.mutable_output()->set_frame_count(20);
  return out;
}

v1::Case endless_case() {
  v1::Case out = small_case();
  out.mutable_lattice()->mutable_hexagon()->set_columns(40);
  out.mutable_lattice()->mutable_hexagon()->set_rows(20);
  out.mutable_loading()->set_speed_m_per_s(1.0);
  out.mutable_output()->set_sample_count(100'000);
  out.mutable_output()->set_frame_count(2000);
  return out;
}

}  // namespace cellcrush::testing
