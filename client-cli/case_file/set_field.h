#pragma once

#include <string_view>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Applies "PATH=VALUE" to a case. PATH is dotted, elements of repeated fields are name[3] (from 0); enums are given by
/// name. Throws CommandError (refused) that names the path and what is expected: an unknown field with the nearest
/// name, a value of the wrong type, a group instead of a field, an element that is not there, a field of another
/// lattice than the case has.
void set_field(v1::Case& target, std::string_view assignment);

}  // namespace cellcrush::client
