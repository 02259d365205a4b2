#include "step/what_is_modelled.h"

#include "beam/wide_walls.h"
#include "cellcrush/contact_faces.h"
#include "scene/check_spec.h"

namespace cellcrush {
namespace {

std::string walls_text(const Scene& scene) {
  return "Walls: Euler beams of constant section, large rotation, " +
         std::string(scene.section.force_based ? "force-based, " : "displacement-based, ") +
         std::to_string(scene.section.section_count()) + " x " + std::to_string(scene.section.depth_count()) +
         " points an element" +
         (has_vector_kernel(scene.section)
              ? "."
              : "; these have no vector kernel and take up to ten times as long. Force-based 4 x 6 and "
                "displacement-based 2 x 6 points have one (section.axial_points, section.depth_points).");
}

std::string fibres_text(const Scene& scene) {
  const std::string law = scene.has_hardening()
                              ? "Fibres: bilinear with mixed hardening, so each remembers its back stress and flow"
                              : "Fibres: perfectly plastic, so each remembers its stress alone";
  return law + (scene.single_fibres
                    ? ", in single precision: half as much to remember, and no error beyond the scatter of seeds."
                    : ", in double precision.");
}

std::string friction_text(double friction) {
  return friction > 0.0 ? "Coulomb friction " + to_text(friction) + "." : "frictionless, so no slip is remembered.";
}

std::string search_text(const Scene& scene) {
  using Premise = ContactFaces::Premise;
  switch (scene.faces.premise) {
    case Premise::holds:
      return "by the faces of the lattice: it is one part, plane and closed, so that only what borders the same face "
             "can "
             "touch. A face or a pair is looked at again when its gap can have been used up.";
    case Premise::several_parts: return "by buckets in space, as there are parts that nothing joins.";
    case Premise::not_closed: return "by buckets in space, as there are walls that close no face.";
    case Premise::not_planar: return "by buckets in space, as walls cross without a joint.";
    case Premise::no_contact:
    case Premise::not_asked: break;
  }
  return "by buckets in space, as asked for (contact.search).";
}

std::string step_text(const Scene& scene) {
  switch (scene.schedule.bound) {
    case StepBound::asked_for: return "as asked for (numerics.time_step_s).";
    case StepBound::elements: return "0.9 of what the lightest, stiffest element bears.";
    case StepBound::plate_travel: return "the time in which the plate moves by a twentieth of the thinnest wall.";
    case StepBound::contacts: return "0.9 of what a row of the lightest particles between contacts bears.";
    case StepBound::stacked_walls: break;
  }
  return "bounded by contacts of walls that are stacked along the crush, which ring and would make energy.";
}

}  // namespace

std::vector<std::string> what_is_modelled(const Scene& scene) {
  std::vector<std::string> lines = {walls_text(scene), fibres_text(scene)};
  if (scene.contact.present) {
    lines.push_back("Contact between walls: penalty, ball to capsule, " + friction_text(scene.contact.friction));
    lines.push_back("Contacts are searched " + search_text(scene));
  } else {
    lines.emplace_back("Contact between walls: left out, as asked for (lattice.frame.self_contact).");
  }
  lines.emplace_back(scene.constant_area ? "Walls that shorten keep the area of their section."
                                         : "Walls that shorten keep their volume; their thickness in the plane stays.");
  if (scene.plates.present) {
    lines.push_back("Plates: rigid, unilateral, not meshed, " + friction_text(scene.plates.friction));
  }
  if (scene.rigid.count() > 0) {
    lines.push_back("Stiff cells: rigid, in " + std::to_string(scene.rigid.count()) +
                    (scene.rigid.count() == 1 ? " body" : " bodies") +
                    ", as they hardly bend among weak ones; not meshed inside, and the step does not depend on them.");
  }
  lines.push_back("Step: " + step_text(scene));
  if (scene.mass_scaling.mass * scene.mass_scaling.rotary > 1.0) {
    lines.push_back(
        "Masses: fictitious, " + to_text(scene.mass_scaling.mass) + " times the real ones (rotary inertia " +
        to_text(scene.mass_scaling.mass * scene.mass_scaling.rotary) + " times), so for slow crushes only.");
  }
  if (!scene.fidelity.empty()) {
    lines.push_back(scene.fidelity);
  }
  lines.emplace_back("Symmetry: not used; from round-off on, halves of a symmetric lattice go their own ways.");
  lines.emplace_back("Left out: fracture, strain-rate dependence, motion out of the plane.");
  return lines;
}

}  // namespace cellcrush
