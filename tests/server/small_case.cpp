#include "server/small_case.h"

#include "programs/text_proto.h"

namespace cellcrush::testing {

v1::Case small_case() {
  return from_text<v1::Case>(R"(
    title: "A few cells"
    lattice { hexagon { columns: 6 rows: 5 side_mm: 4 wall_thickness_mm: 0.3464 } }
    depth_mm: 4
    material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
    loading { speed_m_per_s: 100 end_strain: 0.5 }
    output { sample_count: 100 frame_count: 10 })");
}

v1::Job small_job() {
  v1::Job out;
  *out.mutable_case_() = small_case();
  return out;
}

v1::Case tiny_case() {
  return with_text(small_case(), R"(
    lattice { hexagon { columns: 4 rows: 3 } } loading { end_strain: 0.3 }
    output { sample_count: 20 frame_count: 2 })");
}

v1::Case case_of_seconds() {
  return with_text(small_case(), R"(
    lattice { hexagon { columns: 12 rows: 8 } }
    loading { speed_m_per_s: 5 end_time_s: 0.007 } numerics { time_step_s: 2.8e-7 }
    output { sample_count: 200 frame_count: 20 })");
}

v1::Case endless_case() {
  return with_text(small_case(), R"(
    lattice { hexagon { columns: 40 rows: 20 } } loading { speed_m_per_s: 1 }
    output { sample_count: 100000 frame_count: 2000 })");
}

}  // namespace cellcrush::testing
