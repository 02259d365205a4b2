#include "translate/unimplemented_fields.h"

#include <algorithm>

#include "cellcrush/simulation.h"
#include "cellcrush/v1/case.pb.h"
#include "translate/case_to_spec.h"

namespace cellcrush::translate {
namespace {

// Cases that together use every field that a build may lack. They need not be right otherwise.
std::vector<v1::Case> probes() {
  v1::Case hexagon;
  hexagon.mutable_lattice()->mutable_hexagon();
  hexagon.mutable_lattice()->mutable_imperfection()->set_amplitude_mm(0.01);
  hexagon.mutable_contact()->set_friction(0.1);
  hexagon.mutable_plates()->set_friction(0.1);
  hexagon.mutable_loading()->set_ramp_strain(0.01);
  hexagon.mutable_numerics()->set_mass_damping_per_s(1.0);
  return {hexagon};
}

}  // namespace

std::vector<std::string> unimplemented_fields() {
  std::vector<std::string> out;
  for (const auto& probe : probes()) {
    const auto reading = to_spec(probe);
    const auto built = build_scene(reading.spec);
    for (const Problems* problems : {&reading.problems, &built.problems}) {
      for (const auto& problem : *problems) {
        const bool known = std::find(out.begin(), out.end(), problem.field) != out.end();
        if (problem.kind == Problem::Kind::unimplemented && !known) out.push_back(problem.field);
      }
    }
  }
  return out;
}

}  // namespace cellcrush::translate
