#pragma once

#include <string>

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/problem.pb.h"

namespace cellcrush::translate {

v1::Problem to_proto(const Problem& problem, v1::Problem::Kind kind = v1::Problem::INVALID);

/// A value of the wire that cannot be right. The message goes on from the field's name: "is missing."
Problem invalid_field(std::string field, std::string value, std::string message, std::string remedy);

}  // namespace cellcrush::translate
