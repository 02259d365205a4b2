#pragma once

#include <string>

#include "cellcrush/problem.h"
#include "cellcrush/v1/problem.pb.h"

namespace cellcrush::translate {

v1::Problem to_proto(const Problem& problem);

/// A value of the wire that cannot be right. The message goes on from the field's name: "is missing."
Problem invalid_field(std::string field, std::string value, std::string message, std::string remedy);

/// A field of the wire that the solver's SceneSpec has no place for yet.
Problem unimplemented_field(std::string field, std::string message);

}  // namespace cellcrush::translate
