#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// The number or enum at a dotted path of a case, such as "loading.speed_m_per_s" or "lattice.frame.nodes[3].x_mm", as
/// text; empty if it is absent.
std::string field_value_text(const v1::Case& scene, std::string_view path);

/// The same to read, in six digits; not exact.
std::string short_value_text(const v1::Case& scene, std::string_view path);

/// A field's label: "lattice.hexagon.wall_thickness_mm" is "wall thickness" in "mm". The unit may be empty.
struct FieldWords {
  std::string name;
  std::string unit;
};
FieldWords words_of(std::string_view path);

/// The same among other fields: with its group if another field has the same name, "plates friction".
FieldWords words_among(std::string_view path, const std::vector<std::string>& others);

/// A field with its value among other fields: "speed = 50 m/s".
std::string equation_text(std::string_view path, const std::string& value, const std::vector<std::string>& others);

/// Appends the words of fields to the two lines of a table's heading.
void append_words(const std::vector<std::string>& fields, std::vector<std::string>& names,
                  std::vector<std::string>& units);

/// A case's title without the values that a sweep appended: "Type I" of "Type I, loading.speed_m_per_s = 50".
std::string base_title(const std::string& title);

/// Paths of the numbers and enums in which the cases differ, in the order of the case's fields, excluding title and
/// lists.
std::vector<std::string> find_differences(const std::vector<const v1::Case*>& cases);

/// The same among cases with equal titles, sorted by the number of cases concerned.
std::vector<std::string> find_varied_fields(const std::vector<const v1::Case*>& cases);

/// Values of a case's fields as text: "speed = 50 m/s, wall thickness = 0.3 mm"; those of absent fields are their
/// defaults, "vertical wall thickness by default" if that is no value. Fields that the case cannot have are omitted.
std::string field_values_text(const v1::Case& scene, const std::vector<std::string>& fields);

}  // namespace cellcrush::client
