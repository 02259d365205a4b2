#include <algorithm>
#include <cmath>
#include <numeric>

#include "beam/element_place.h"
#include "cellcrush/contact_faces.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "measure/theory.h"
#include "push/crush.h"
#include "push/half_planes.h"
#include "scene/check_spec.h"
#include "scene/rigid_links.h"
#include "scene/slowest_wall.h"
#include "scene/solid_area.h"
#include "scene/time_step.h"
#include "section/section_rule.h"
#include "step/plate_control.h"

namespace cellcrush {
namespace {

/// Cost of a wall that is told.
constexpr double kWorthTelling = 1.1;

constexpr const char* kFailureText =
    "Failure: a wall breaks where the plastic strain at a surface in tension, as a mean over a length of one wall "
    "thickness, reaches material.failure_strain; rate and state of stress have no influence. Its end then moves on its "
    "own. It touches what it was joined to once they have parted by a thickness; until then it can pass through.";

std::string walls_text(const Scene& scene) {
  return (scene.walls.shear.empty()
              ? "Walls: Euler beams of constant section, large rotation, "
              : "Walls: Timoshenko beams of constant section, large rotation, that shear "
                "elastically with a shear factor of " +
                    to_text(scene.section.shear_factor) + " (the shear force does not lower the plastic moment), ") +
         (scene.section.coupled_bending ? "bending coupled with stretching, " : "") +
         std::string(scene.section.force_based ? "force-based, " : "displacement-based, ") +
         std::to_string(scene.section.section_count()) + " x " + std::to_string(scene.section.depth_count()) +
         " integration points per element" +
         (has_known_counts(scene.section)
              ? "."
              : "; these are computed one element at a time, so the run takes up to ten times as long. "
                "Force-based 4 x 6 and displacement-based 2 x 6 points are computed side by side "
                "(section.axial_points, section.depth_points).");
}

std::string fibres_text(const Scene& scene) {
  const LawFacts& facts = Laws::kFacts[scene.law];
  const std::string law = "Fibres: " + std::string(facts.words);
  if (scene.single_fibres) {
    return law + ", in single precision, which halves the memory and adds no error beyond the scatter between seeds.";
  }
  if (scene.slow_loading) {
    return law + ", in double precision: in single precision, rounding errors of slow loading add up.";
  }
  return law + ", in double precision" +
         (!facts.may_be_single ? ", as its law requires."
          : scene.can_break()  ? ", as walls that can break require."
          : scene.section.force_based && !facts.may_be_single_in_force_based
              ? ", as hardening requires in force-based elements."
              : ".");
}

std::string search_text(const Scene& scene) {
  using Premise = ContactFaces::Premise;
  switch (scene.faces.premise) {
    case Premise::holds:
      return "by the faces of the lattice: it is connected, planar and closed, so only walls that border the same face "
             "can touch. A face or a pair is rechecked once its gap may have closed.";
    case Premise::several_parts: return "by buckets in space, because the lattice has separate parts.";
    case Premise::not_closed: return "by buckets in space, because some walls do not close a face.";
    case Premise::not_planar: return "by buckets in space, because walls cross without a joint.";
    case Premise::sides_repeat: return "by buckets in space, because the sides repeat.";
    case Premise::walls_break: return "by buckets in space, because walls can break.";
    case Premise::no_contact:
    case Premise::not_asked: break;
  }
  return "by buckets in space, as requested (contact.search).";
}

/// The wall whose elements set the step, and what it costs.
std::string slowest_text(const Scene& scene) {
  const SlowestWall slowest = slowest_wall_of(scene);
  const std::string wall = "in a wall " + words_of(slowest);
  return slowest.cost < kWorthTelling
             ? wall + ", as in others."
             : wall + ". Half of the walls allow a step " + times_text(slowest.cost) + " times as long.";
}

std::string grips_text(const Scene& scene) {
  const std::size_t grips = scene.grips.size();
  const std::size_t points = scene.gripped.size();
  return "Grips: " + std::to_string(grips) + (grips == 1 ? ", holds " : ", hold ") + std::to_string(points) +
         (points == 1 ? " point" : " points") +
         " of the mesh as one each, without turning, in tension as in compression; a wall across the line of a grip is "
         "free from its first point before it.";
}

std::string period_text(const Scene& scene) {
  const Period& period = scene.period;
  const std::size_t pairs = period.low.size();
  return "Sides: repeat after " + to_text(period.length) + " mm, at " + std::to_string(pairs) +
         (pairs == 1 ? " joint" : " joints") + ", walls touch across them; " +
         (period.is_fixed ? "the width is held, so that no Poisson's ratio shows."
                          : "the width is free, with no mean stress across the crush and the inertia of the strip.");
}

/// Walls that are rigid because they are short.
std::string links_text(const Scene& scene) {
  const std::size_t count = scene.rigid.links;
  return "Rigid links: " + std::to_string(count) + (count == 1 ? " wall" : " walls") + " in " +
         std::to_string(scene.rigid.count()) + (scene.rigid.count() == 1 ? " rigid body" : " rigid bodies") +
         ", short for the thickness (numerics.rigid_link_slenderness), with " +
         times_text(100.0 * link_mass_share_of(scene)) + " % of the mass; no mass is added.";
}

/// Walls that overlap before loading.
std::string overlaps_text(const Scene& scene) {
  const std::size_t count = scene.start_overlaps.walls().size();
  const Vector2& place = scene.position[scene.start_overlaps.pairs.front().ball];
  return "Overlaps before loading: " + std::to_string(count) + (count == 1 ? " pair" : " pairs") +
         " of walls, at sharp joints or side by side, first at (" + to_text(place.x()) + ", " + to_text(place.y()) +
         ") mm. Until they have parted, they push each other only when closer than before loading.";
}

std::string step_text(const Scene& scene) {
  switch (scene.schedule.bound) {
    case StepBound::asked_for: return "as requested (numerics.time_step_s).";
    case StepBound::elements:
      return to_text(scene.section.force_based ? kForceBasedStepFraction : kStepFraction) +
             " of the stability limit of the lightest, stiffest element or pair of elements, " + slowest_text(scene);
    case StepBound::plate_travel:
      return "the time in which the plate moves by " + to_text(kTravelPerStep) +
             " of the thinnest wall's thickness or " + to_text(kTurnPerStep) + " of the shortest element's length.";
    case StepBound::approach:
      return "the time in which beams approach each other by " + to_text(kTravelPerStep) +
             " of the thinnest one's thickness, at the speed that contacts are made for "
             "(contact.impact_speed_m_per_s).";
    case StepBound::contacts: return "0.9 of the stability limit of a row of the lightest particles between contacts.";
    case StepBound::stacked_walls: break;
  }
  return "limited by contacts of walls stacked along the crush direction, which oscillate and would create energy.";
}

/// Depth of the walls over the mean of their thickness, and of their length. Walls in a chain count as one.
struct WallDepth {
  double over_thickness = 0.0;
  double over_length = 0.0;
};

WallDepth depth_of(const Scene& scene) {
  const Walls& walls = scene.walls;
  double thickness = 0.0;
  double length = 0.0;
  for (const WallBlock& block : walls.blocks) {
    for (int wall = block.first_wall; wall < block.first_wall + block.walls; ++wall) {
      thickness += walls.thickness[wall];
      length += block.elements * walls.undeformed_length[wall];
    }
  }
  auto chains = static_cast<double>(walls.thickness.size());
  for (int joint = 0; joint < scene.joint_count; ++joint) {
    if (scene.wall_end_offset[joint + 1] - scene.wall_end_offset[joint] == 2) chains -= 1.0;
  }
  return {scene.depth * static_cast<double>(walls.thickness.size()) / thickness,
          scene.depth * std::max(chains, 1.0) / length};
}

/// How walls contract along their depth, and what their shape asks for (E6b): hinges are one to two thicknesses long.
std::string plane_text(const Scene& scene) {
  const Material& material = scene.materials.front();
  const std::string given = !material.plane_strain ? "PLANE_STRESS" : material.strip ? "STRIP" : "PLANE_STRAIN";
  std::string text = "Plane: walls " +
                     std::string(!material.plane_strain ? "can contract along the depth"
                                 : material.strip       ? "bend elastically in plane stress and flow in plane strain"
                                                        : "cannot contract along the depth") +
                     " (material.plane " + given + ").";
  if (scene.walls.thickness.empty()) return text;
  const WallDepth depth = depth_of(scene);
  const bool wide = depth.over_thickness > 2.0;
  const std::string fitting = !wide ? "PLANE_STRESS" : depth.over_length < 1.0 ? "STRIP" : "PLANE_STRAIN";
  if (given == fitting) return text;
  text += " They are " + to_text(std::round(10.0 * depth.over_thickness) / 10.0) + " times as deep as thick";
  if (wide) text += " and " + to_text(std::round(100.0 * depth.over_length) / 100.0) + " times as deep as long";
  const std::string plane = " (" + fitting + ").";
  if (!wide) return text + ": real ones flow in plane stress" + plane;
  if (!material.plane_strain)
    return text + ": real ones flow in plane strain, at up to 1.15 times the yield stress" + plane;
  return text + ": real ones bend elastically in plane " + (material.strip ? "strain, too" : "stress") + plane;
}

/// What is modelled and what is left out, one sentence each.
std::vector<std::string> what_is_modelled(const Scene& scene) {
  std::vector<std::string> lines = {walls_text(scene), fibres_text(scene)};
  if (scene.contact.present) {
    lines.push_back("Contact between walls: penalty, ball to capsule, " + friction_words(scene.contact.friction));
    lines.push_back("Contacts are searched " + search_text(scene));
    if (!scene.start_overlaps.empty()) {
      lines.push_back(overlaps_text(scene));
    }
  } else {
    lines.emplace_back("Contact between walls: none, as requested (lattice.frame.self_contact).");
  }
  lines.emplace_back(
      scene.constant_area
          ? "Cross-section: walls keep their cross-sectional area; strains are taken over undeformed lengths."
          : "Cross-section: walls that shorten by plastic flow keep their volume and grow thicker, in " +
                std::string(scene.materials.front().plane_strain ? "the plane." : "the plane and in depth alike.") +
                std::string(scene.can_break() ? " Walls that are stretched keep their area."
                                              : " Walls that are stretched keep their area and do not neck."));
  lines.push_back(plane_text(scene));
  for (const Pusher* pusher : pushers()) {
    pusher->describe(scene, lines);
  }
  if (!scene.grips.empty()) {
    lines.push_back(grips_text(scene));
  }
  if (scene.period.repeats()) {
    lines.push_back(period_text(scene));
  }
  if (scene.pins.count() > 0) {
    const std::size_t ends = scene.pins.joint.size() - scene.pins.count();
    lines.push_back("Pins: " + std::to_string(ends) + (ends == 1 ? " end of a beam turns" : " ends of beams turn") +
                    " freely at the node, without friction.");
  }
  if (scene.rigid.are_joints) {
    lines.push_back("Joints: " + std::to_string(scene.rigid.count()) +
                    " rigid bodies, up to where the faces of their walls meet; walls deform between them. Real joints "
                    "deform too.");
  } else if (scene.rigid.links > 0) {
    lines.push_back(links_text(scene));
  } else if (scene.rigid.count() > 0) {
    lines.push_back(
        "Stiff cells: rigid, in " + std::to_string(scene.rigid.count()) +
        (scene.rigid.count() == 1 ? " body" : " bodies") +
        ", because they hardly bend among weak cells; their interior is not meshed and does not limit the step.");
  }
  lines.push_back("Step: " + step_text(scene));
  if (scene.mass_scaling.mass * scene.mass_scaling.rotary > 1.0) {
    lines.push_back("Masses: fictitious, " + to_text(scene.mass_scaling.mass) +
                    " times the real ones (rotary inertia " +
                    to_text(scene.mass_scaling.mass * scene.mass_scaling.rotary) + " times); for slow crushes only.");
  }
  if (!scene.fidelity.empty()) {
    lines.push_back(scene.fidelity);
  }
  lines.emplace_back("Symmetry: not used; round-off makes the halves of a symmetric lattice deform differently.");
  const auto depends = [](const Material& material) { return material.law.depends_on_rate(); };
  if (scene.can_break()) lines.emplace_back(kFailureText);
  lines.push_back("Not modelled: " + std::string(scene.can_break() ? "" : "fracture, ") +
                  std::string(std::ranges::any_of(scene.materials, depends) ? "" : "strain-rate dependence, ") +
                  "out-of-plane motion.");
  return lines;
}

}  // namespace

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  facts.particle_count = static_cast<std::int64_t>(scene.particle_count());
  facts.element_count = static_cast<std::int64_t>(scene.element_count());
  facts.wall_count = static_cast<std::int64_t>(scene.wall_count());
  facts.mass = scene.total_mass;
  facts.relative_density = relative_density_of(scene);
  facts.length = scene.length;
  facts.width = scene.width;
  facts.valid_to_strain = closing_strain_of(scene);
  facts.end = scene.schedule.end;
  facts.stable_step = scene.stable_step;
  facts.time_step = scene.schedule.time_step;
  facts.step_count = scene.schedule.step_count;
  facts.most_steps = most_steps_of(scene);
  facts.end_strain = is_controlled(scene) ? scene.plates.end_travel / scene.length : 0.0;
  facts.sample_interval = scene.schedule.sample_interval;
  facts.frame_interval = scene.schedule.frame_interval;
  facts.theory = theory_of(scene);
  facts.modelled = what_is_modelled(scene);
  return facts;
}

MeshView mesh_of(const Scene& scene) {
  MeshView mesh;
  for (const Vector2& position : scene.position) {
    mesh.position.push_back(static_cast<float>(position.x()));
    mesh.position.push_back(static_cast<float>(position.y()));
  }
  for (const Element& element : scene.elements) {
    mesh.element_nodes.push_back(element.start);
    mesh.element_nodes.push_back(element.end);
    mesh.thickness.push_back(static_cast<float>(element.thickness));
  }
  mesh.element_wall.resize(scene.element_count());
  visit_elements(scene, [&mesh](const ElementPlace& place, int wall) { mesh.element_wall[place.element] = wall; });
  std::iota(mesh.element_wall.begin() + scene.rigid.first_element, mesh.element_wall.end(),
            static_cast<int>(scene.walls.start.size()));
  for (int& wall : mesh.element_wall) wall = scene.list_order.listed_wall(wall);
  mesh.rigid_elements = static_cast<int>(scene.rigid_element_count());
  for (const StartOverlap& pair : scene.start_overlaps.pairs) {
    if (mesh.overlap_particle.empty() || mesh.overlap_particle.back() != pair.ball) {
      mesh.overlap_particle.push_back(pair.ball);
    }
  }
  mesh.length = scene.length;
  mesh.width = scene.width;
  mesh.impact_plate = scene.plates.impact_face;
  mesh.support_plate = scene.plates.support_face;
  mesh.along_y = is_crushed(scene) && crush_axis_of(scene) == 1;
  if (const auto sides = side_walls_of(scene); sides.size() == 2) {
    const int across = sides[0].normal.x() != 0.0 ? 0 : 1;
    mesh.side_low = sides[0].point[across];
    mesh.side_high = sides[1].point[across];
  }
  mesh.gripped = scene.gripped;
  return mesh;
}

}  // namespace cellcrush
