#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// A case's title without the values that a sweep appended: "Type I" of "Type I, loading.speed_m_per_s = 50".
std::string base_title(const std::string& title);

/// Paths of the numbers and enums in which the cases differ, in the order of the case's fields, excluding title and
/// lists.
std::vector<std::string> find_differences(const std::vector<const v1::Case*>& cases);

/// The same among cases with equal titles, sorted by the number of cases concerned.
std::vector<std::string> find_varied_fields(const std::vector<const v1::Case*>& cases);

/// Values of a case's fields as text: "speed = 50 m/s, wall thickness = 0.3 mm"; absent fields are omitted.
std::string field_values_text(const v1::Case& scene, const std::vector<std::string>& fields);

}  // namespace cellcrush::client
