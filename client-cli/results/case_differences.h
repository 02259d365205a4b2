#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// A case's title without the values that a sweep has put behind it: "Type I" of "Type I, loading.speed_m_per_s = 50".
std::string base_title(const std::string& title);

/// Paths of the numbers and choices in which the cases differ, in the order of the case's fields; its title is none of
/// them. Those in lists are left out.
std::vector<std::string> find_differences(const std::vector<const v1::Case*>& cases);

/// Those in which cases of one title differ, those of the most cases first.
std::vector<std::string> find_varied_fields(const std::vector<const v1::Case*>& cases);

/// Values of a case's fields in words: "speed = 50 m/s, wall thickness = 0.3 mm"; fields that it does not have are left
/// out.
std::string field_values_text(const v1::Case& scene, const std::vector<std::string>& fields);

}  // namespace cellcrush::client
