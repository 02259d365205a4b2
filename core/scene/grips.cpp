#include "scene/grips.h"

#include <string>
#include <utility>

#include "scene/mesh_part.h"

namespace cellcrush {
namespace {

using Edge = LoadsSpec::Grip::Edge;
using FixedTo = LoadsSpec::Grip::FixedTo;

std::string path_of_grip(std::size_t grip) { return "loading.grips[" + std::to_string(grip) + "]"; }

/// The edge at which a plate stands.
Edge edge_of(const SceneSpec& spec, FixedTo plate) {
  const bool along_x = crush_axis_of(spec) == 0;
  return plate == FixedTo::impact_plate ? (along_x ? Edge::left : Edge::bottom) : (along_x ? Edge::right : Edge::top);
}

const char* name_of(Edge edge) {
  switch (edge) {
    case Edge::left: return "LEFT";
    case Edge::right: return "RIGHT";
    case Edge::bottom: return "BOTTOM";
    case Edge::top: break;
  }
  return "TOP";
}

const char* name_of(FixedTo fixed_to) {
  switch (fixed_to) {
    case FixedTo::ground: return "GROUND";
    case FixedTo::impact_plate: return "IMPACT_PLATE";
    case FixedTo::support_plate: break;
  }
  return "SUPPORT_PLATE";
}

/// A plate has to be there, at the edge, and moves what is fixed to it.
void check_plate_of(const SceneSpec& spec, const std::string& path, const LoadsSpec::Grip& grip, FieldChecker& check) {
  if (grip.fixed_to == FixedTo::ground) return;
  const std::string name = name_of(grip.fixed_to);
  if (!has_plates(spec)) {
    check.add(path + ".fixed_to", name, "is not there: the case has no plates.",
              "Give loading.speed_m_per_s or loading.quasi_static, or set fixed_to to GROUND.");
  } else if (grip.edge != edge_of(spec, grip.fixed_to)) {
    check.add(path + ".edge", name_of(grip.edge), "is not the edge at the " + name + ".",
              std::string("Set edge to ") + name_of(edge_of(spec, grip.fixed_to)) + ", or fixed_to to GROUND.");
  }
  for (const auto& [field, points] :
       {std::pair(".displacement_x_mm", &grip.x_points), std::pair(".displacement_y_mm", &grip.y_points)}) {
    if (!points->empty()) {
      check.add(path + field, "", "is given for a grip that is fixed to the " + name + ".",
                "Remove it, or set fixed_to to GROUND.");
    }
  }
}

/// Registers the imposed displacement of a component of a grip.
Hold hold_of(const LoadsSpec::TimeFunction& points, Scene& scene) {
  if (points.empty()) return {true, Hold::kStill};
  scene.motions.push_back({points});
  return {true, static_cast<int>(scene.motions.size()) - 1};
}

}  // namespace

std::vector<GripLine> grip_lines_of(const SceneSpec& spec, const Bounds& envelope) {
  constexpr double kRounded = 1e-9;  // of the extent
  std::vector<GripLine> lines;
  for (const LoadsSpec::Grip& grip : spec.loads.grips) {
    GripLine& line = lines.emplace_back();
    line.axis = axis_of(grip.edge);
    const bool is_high = grip.edge == Edge::right || grip.edge == Edge::top;
    line.outward = is_high ? 1.0 : -1.0;
    line.place = grip.line_mm.value_or((is_high ? envelope.high : envelope.low)[line.axis]);
    line.rounding = spec.imperfection.amplitude_mm + kRounded * (envelope.high - envelope.low).maxCoeff();
  }
  return lines;
}

void check_grips(const SceneSpec& spec, FieldChecker& check) {
  for (std::size_t i = 0; i < spec.loads.grips.size(); ++i) {
    const LoadsSpec::Grip& grip = spec.loads.grips[i];
    const std::string path = path_of_grip(i);
    if (grip.line_mm) check.within_limits(path + ".line_mm", grip.line_mm);
    if (!grip.x_points.empty()) check.is_function_of_time(path + ".displacement_x_mm", grip.x_points);
    if (!grip.y_points.empty()) check.is_function_of_time(path + ".displacement_y_mm", grip.y_points);
    check_plate_of(spec, path, grip, check);
  }
}

void attach_grips(const SceneSpec& spec, const Bounds& envelope, Scene& scene) {
  if (spec.loads.grips.empty()) {
    return;
  }
  scene.supports.resize(scene.particle_count());
  const std::vector<GripLine> lines = grip_lines_of(spec, envelope);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LoadsSpec::Grip& from = spec.loads.grips[i];
    Grip& grip = scene.grips.emplace_back();
    grip.fixed_to = static_cast<Grip::FixedTo>(from.fixed_to);
    grip.x = hold_of(from.x_points, scene);
    grip.y = hold_of(from.y_points, scene);
    if (from.fixed_to == FixedTo::impact_plate)
      (crush_axis_of(spec) == 0 ? grip.x : grip.y).motion = Hold::kWithImpactPlate;
    grip.first = static_cast<int>(scene.gripped.size());
    for (int particle = 0; particle < static_cast<int>(scene.particle_count()); ++particle) {
      if (!lines[i].holds(scene.position[particle])) continue;
      Support& support = scene.supports[particle];
      if (particle < scene.rigid.particle_count() || support.x.held || support.y.held || support.rotation.held) {
        ++grip.taken;
      } else {
        support = {grip.x, grip.y, {true, Hold::kStill}};
        scene.gripped.push_back(particle);
      }
    }
    grip.end = static_cast<int>(scene.gripped.size());
  }
}

Problems find_grip_problems(const Scene& scene) {
  FieldChecker check;
  for (std::size_t i = 0; i < scene.grips.size(); ++i) {
    const Grip& grip = scene.grips[i];
    if (grip.taken > 0) {
      check.add(path_of_grip(i), std::to_string(grip.taken) + " points",
                "beyond its line are held by a support, a motion or another grip, or belong to rigid cells.",
                "Move line_mm towards the edge or remove what holds them; set lattice.inclusions.model to MESHED for "
                "rigid cells.");
    } else if (grip.first == grip.end) {
      check.add(path_of_grip(i) + ".line_mm", "", "leaves nothing of the lattice to grip.",
                "Move the line into the lattice, or leave it out: the grip then holds the joints on the edge.");
    }
  }
  return check.take();
}

}  // namespace cellcrush
