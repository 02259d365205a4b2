#include <algorithm>
#include <string>
#include <variant>

#include "scene/check_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {
namespace {

/// One section in the middle of a displacement-based element would let it bend into an S freely. Two Lobatto points
/// have three times the bending stiffness, three have two thirds of the plastic moment.
void check_section(const SectionSpec& section, FieldChecker& check) {
  const bool force_based = section.formulation == SectionSpec::Formulation::force_based;
  check.in_range("section.axial_points", section.axial_count(),
                 force_based ? FieldChecker::Range{3, 5} : FieldChecker::Range{2, 5},
                 force_based ? " (force-based; displacement-based: 2 to 5)" : "");
  if (section.depth_rule == SectionSpec::DepthRule::lobatto) {
    check.in_range("section.depth_points", section.depth_count(), {4, 10});
  } else if (section.depth_count() != 4 && section.depth_count() != 6 && section.depth_count() != 10) {
    check.add("section.depth_points", std::to_string(section.depth_count()),
              "is not available in the full-moment rule.",
              "Give 4, 6 or 10, or section.depth_rule LOBATTO with 4 to 10.");
  }
  if (section.shear_deformation && !force_based) {
    check.add("section.shear_deformation", "true", "does not go with displacement-based elements, which do not shear.",
              "Set section.formulation to FORCE_BASED, or remove it.");
  }
  const bool is_sound =
      check.within_limits("section.shear_factor", section.shear_factor, " (shear area over section area)");
  if (is_sound && !section.shear_deformation && section.shear_factor != SectionSpec().shear_factor) {
    check.add("section.shear_factor", to_text(section.shear_factor), "is that of walls that shear, but they do not.",
              "Set section.shear_deformation, or remove it.");
  }
}

void check_coupled_bending(const SceneSpec& spec, FieldChecker& check) {
  if (!spec.section.coupled_bending) return;
  if (spec.section.area_rule == SectionSpec::AreaRule::constant_area) {
    check.add("section.coupled_bending", "true", "does not go with walls of constant area.",
              "Set section.area_rule to CONSTANT_VOLUME, or remove it.");
  }
  if (std::ranges::any_of(material_specs_of(spec), &LawParameters::fails)) {
    check.add("section.coupled_bending", "true", "does not go with walls that break.",
              "Leave material.failure_strain out, or remove it.");
  }
}

void check_rigid_joints(const SceneSpec& spec, FieldChecker& check) {
  if (!spec.section.rigid_joints) return;
  if (std::holds_alternative<FrameWalls>(spec.lattice)) {
    check.add("section.rigid_joints", "true", "does not go with a frame, whose beams are listed in pieces.",
              "Remove it, or list stiff beams at the joints.");
  }
  if (spec.loading.sides.kind == LoadingSpec::Sides::Kind::periodic) {
    check.add("section.rigid_joints", "true", "does not go with sides that repeat.",
              "Remove it, or set loading.sides.kind to FREE or RIGID.");
  }
}

}  // namespace

void check_section_and_contact(const SceneSpec& spec, FieldChecker& check) {
  check_section(spec.section, check);
  check_coupled_bending(spec, check);
  check_rigid_joints(spec, check);
  check.within_limits("contact.friction", spec.contact.friction);
  check.within_limits("contact.stiffness_factor", spec.contact.stiffness_factor);
  check.within_limits("contact.damping_ratio", spec.contact.damping_ratio);
  check.within_limits("contact.impact_speed_m_per_s", spec.contact.impact_speed_m_per_s, " (0: as the case tells)");
}

}  // namespace cellcrush
