#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Whether two plates crush the lattice.
inline bool has_plates(const v1::Case& scene) { return scene.loading().has_speed_m_per_s(); }

/// The number or enum at a dotted path of a case, such as "loading.speed_m_per_s" or "lattice.frame.nodes[3].x_mm", as
/// text; empty if it is absent.
std::string field_value_text(const v1::Case& scene, std::string_view path);

/// A field's label: "lattice.hexagon.wall_thickness_mm" is "wall thickness" in "mm". The unit may be empty.
struct FieldWords {
  std::string name;
  std::string unit;
};
FieldWords words_of(std::string_view path);

/// The same among other fields: with its group if another field has the same name, "plates friction".
FieldWords words_among(std::string_view path, const std::vector<std::string>& others);

}  // namespace cellcrush::client
