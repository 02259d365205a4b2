#include "translate/loads_places.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <array>

#include "translate/problems.h"
#include "translate/spec_to_case.h"

namespace cellcrush::translate {
namespace {

constexpr std::string_view kLoading = "loading.";
constexpr std::string_view kFrame = "lattice.frame.";
constexpr std::array<const char*, 4> kFields = {"gravity_x_m_per_s2", "gravity_y_m_per_s2", "rigid_walls",
                                                "end_time_s"};

bool has(const google::protobuf::Message& message, const char* name) {
  const auto* field = message.GetDescriptor()->FindFieldByName(name);
  return field->is_repeated() ? message.GetReflection()->FieldSize(message, field) > 0
                              : message.GetReflection()->HasField(message, field);
}

// The message that has a field of a case: its loading, or its frame.
const google::protobuf::Message& holder_of(const v1::Case& scene, const char* name) {
  const bool in_frame = scene.lattice().has_frame() && !has(scene.loading(), name);
  return in_frame ? static_cast<const google::protobuf::Message&>(scene.lattice().frame()) : scene.loading();
}

double number_of(const v1::Case& scene, const char* name) {
  const google::protobuf::Message& holder = holder_of(scene, name);
  return holder.GetReflection()->GetDouble(holder, holder.GetDescriptor()->FindFieldByName(name));
}

template <class Holder>
void write_to(const SceneSpec& spec, Holder& out) {
  if (spec.loading.end_time_s) out.set_end_time_s(*spec.loading.end_time_s);
  for (std::size_t i = 0; i < spec.loads.rigid_walls.size(); ++i) {
    const LoadsSpec::RigidWall& wall = spec.loads.rigid_walls[i];
    v1::Frame::RigidWall& added = *out.add_rigid_walls();
    added.set_id(std::to_string(i));
    added.set_x_mm(wall.x_mm);
    added.set_y_mm(wall.y_mm);
    added.set_normal_x(wall.normal_x);
    added.set_normal_y(wall.normal_y);
    added.set_friction(wall.friction);
    if (!wall.points.empty()) write_function(wall.points, *added.mutable_displacement_mm());
    for (const auto& [name, value] : wall.own)
      added.GetReflection()->SetDouble(&added, added.GetDescriptor()->FindFieldByName(name), value);
  }
}

}  // namespace

const RigidWalls& rigid_walls_of(const v1::Case& scene) {
  return scene.loading().rigid_walls().empty() ? scene.lattice().frame().rigid_walls() : scene.loading().rigid_walls();
}

void read_loads(const v1::Case& in, SceneSpec& spec, Problems& problems) {
  for (const char* name : kFields) {
    if (has(in.loading(), name) && has(in.lattice().frame(), name)) {
      const std::string other = std::string(kFrame) + name;
      problems.push_back(
          invalid_field(std::string(kLoading) + name, "", "is given as " + other + " too.", "Remove one of the two."));
    }
  }
  spec.loads.gravity_x_m_per_s2 = number_of(in, "gravity_x_m_per_s2");
  spec.loads.gravity_y_m_per_s2 = number_of(in, "gravity_y_m_per_s2");
  if (has(holder_of(in, "end_time_s"), "end_time_s")) spec.loading.end_time_s = number_of(in, "end_time_s");
  const bool in_loading = !in.loading().rigid_walls().empty();
  spec.loads.rigid_walls =
      read_rigid_walls(rigid_walls_of(in), std::string(in_loading ? kLoading : kFrame) + "rigid_walls", problems);
}

void write_loads(const SceneSpec& spec, v1::Case& out) {
  const LoadsSpec& loads = spec.loads;
  if (out.lattice().has_frame()) {
    out.mutable_lattice()->mutable_frame()->set_gravity_x_m_per_s2(loads.gravity_x_m_per_s2);
    out.mutable_lattice()->mutable_frame()->set_gravity_y_m_per_s2(loads.gravity_y_m_per_s2);
    write_to(spec, *out.mutable_lattice()->mutable_frame());
    return;
  }
  if (loads.gravity_x_m_per_s2 != 0.0) out.mutable_loading()->set_gravity_x_m_per_s2(loads.gravity_x_m_per_s2);
  if (loads.gravity_y_m_per_s2 != 0.0) out.mutable_loading()->set_gravity_y_m_per_s2(loads.gravity_y_m_per_s2);
  write_to(spec, *out.mutable_loading());
}

void name_as_given(const v1::Case& submitted, Problems& problems) {
  for (Problem& problem : problems) {
    const bool is_of_frame = std::ranges::any_of(kFields, [&](const char* name) {
      return problem.field.starts_with(std::string(kLoading) + name) &&
             &holder_of(submitted, name) != &submitted.loading();
    });
    if (is_of_frame) problem.field.replace(0, kLoading.size(), kFrame);
  }
}

}  // namespace cellcrush::translate
