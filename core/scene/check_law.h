#pragma once

#include <string>

#include "fields/field_checker.h"

namespace cellcrush {

/// What the parameters of a material's law must be to each other, and its tables. `path` ends with a dot.
void check_law(const std::string& path, const MaterialSpec& material, FieldChecker& check);

}  // namespace cellcrush
