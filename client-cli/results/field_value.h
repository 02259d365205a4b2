#pragma once

#include <string>
#include <string_view>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// The value of the number at a dotted path of a case, such as "loading.speed_m_per_s", as text; empty when the case has
/// no number there.
std::string field_value_text(const v1::Case& scene, std::string_view path);

/// A field in words: "lattice.hexagon.wall_thickness_mm" is a "wall thickness" in "mm". The unit may be empty.
struct FieldWords {
  std::string name;
  std::string unit;
};
FieldWords words_of(std::string_view path);

/// The last part of a path: "speed_m_per_s".
std::string_view last_part(std::string_view path);

}  // namespace cellcrush::client
