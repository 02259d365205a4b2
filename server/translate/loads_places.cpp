#include "translate/loads_places.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>

#include "translate/network_lists.h"

namespace cellcrush::translate {
namespace {

using google::protobuf::Message;

const std::string kLoading = "loading.";
const std::string kFrame = "lattice.frame.";
constexpr const char* kFields[] = {"gravity_x_m_per_s2", "gravity_y_m_per_s2", "rigid_walls", "end_time_s"};

bool has(const Message& message, const char* name) {
  const auto* field = message.GetDescriptor()->FindFieldByName(name);
  return field->is_repeated() ? message.GetReflection()->FieldSize(message, field) > 0
                              : message.GetReflection()->HasField(message, field);
}

void copy_field(const Message& from, Message& to, const char* name) {
  const auto* source = from.GetDescriptor()->FindFieldByName(name);
  const auto* target = to.GetDescriptor()->FindFieldByName(name);
  if (!source->is_repeated()) {
    to.GetReflection()->SetDouble(&to, target, from.GetReflection()->GetDouble(from, source));
  }
  for (int i = 0; source->is_repeated() && i < from.GetReflection()->FieldSize(from, source); ++i) {
    to.GetReflection()->AddMessage(&to, target)->CopyFrom(from.GetReflection()->GetRepeatedMessage(from, source, i));
  }
}

void move_field(Message& from, Message& to, const char* name) {
  copy_field(from, to, name);
  from.GetReflection()->ClearField(&from, from.GetDescriptor()->FindFieldByName(name));
}

}  // namespace

void move_to_loading(v1::Case& scene, Problems& problems) {
  if (!scene.lattice().has_frame()) return;
  for (const char* name : kFields) {
    if (!has(scene.lattice().frame(), name)) continue;
    if (has(scene.loading(), name)) {
      problems.push_back({kLoading + name, "", "is given as " + kFrame + name + " too.", "Remove one of the two."});
    } else {
      move_field(*scene.mutable_lattice()->mutable_frame(), *scene.mutable_loading(), name);
    }
  }
}

void move_to_frame(v1::Case& scene) {
  if (!scene.lattice().has_frame()) return;
  for (const char* name : kFields) {
    if (has(scene.loading(), name))
      move_field(*scene.mutable_loading(), *scene.mutable_lattice()->mutable_frame(), name);
  }
}

void name_as_given(const v1::Case& submitted, Problems& problems) {
  if (submitted.lattice().has_network()) name_compact(submitted.lattice().network(), problems);
  if (!submitted.lattice().has_frame()) return;
  for (Problem& problem : problems) {
    for (const char* name : kFields) {
      if (problem.field.starts_with(kLoading + name) && !has(submitted.loading(), name))
        problem.field.replace(0, kLoading.size(), kFrame);
    }
  }
}

v1::Loading loading_of(const v1::Case& scene) {
  v1::Loading loading = scene.loading();
  for (const char* name : kFields) {
    if (!has(loading, name) && has(scene.lattice().frame(), name)) copy_field(scene.lattice().frame(), loading, name);
  }
  return loading;
}

const google::protobuf::RepeatedPtrField<v1::Frame::RigidWall>& rigid_walls_of(const v1::Case& scene) {
  return scene.loading().rigid_walls().empty() ? scene.lattice().frame().rigid_walls() : scene.loading().rigid_walls();
}

void restore_ids(const v1::Case& submitted, v1::Case& completed) {
  for (int i = 0; i < rigid_walls_of(submitted).size(); ++i) {
    auto* const wall = completed.lattice().has_frame()
                           ? completed.mutable_lattice()->mutable_frame()->mutable_rigid_walls(i)
                           : completed.mutable_loading()->mutable_rigid_walls(i);
    wall->set_id(rigid_walls_of(submitted)[i].id());
  }
  for (int i = 0; i < submitted.loading().grips_size(); ++i) {
    completed.mutable_loading()->mutable_grips(i)->set_id(submitted.loading().grips(i).id());
  }
}

}  // namespace cellcrush::translate
