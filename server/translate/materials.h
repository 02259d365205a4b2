#pragma once

#include <string>

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

/// The named materials, in the order they are listed in.
const v1::ListMaterialsResponse& materials();

bool is_named_material(const std::string& name);

/// The names of all of them, as an error lists them.
std::string known_materials();

/// The material with the numbers of the one that it names, except for those that it gives; as it is if it names none
/// that is known.
v1::Material with_named(const v1::Material& material);

/// The same of all materials of a case: what is computed does not change if the list of materials does.
v1::Case with_named_materials(v1::Case of);

/// Notes on what is implausible in a case: `notes`, less those on numbers that its named material gives, and one if the
/// case gives all numbers of that material otherwise.
Problems notes_on_named(const v1::Case& of, Problems notes);

}  // namespace cellcrush::translate
