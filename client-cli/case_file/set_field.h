#pragma once

#include <string_view>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Applies "PATH=VALUE" to a case. PATH is dotted, with name[3] for elements of repeated fields (from 0); enums are
/// given by name. Throws CommandError (refused), naming the path and what is expected. Causes: an unknown field (with
/// the nearest name), a value of the wrong type, a message instead of a field, a missing element, or a field of a
/// different lattice than the case has.
void set_field(v1::Case& target, std::string_view assignment);

}  // namespace cellcrush::client
