#pragma once

#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

// What the build embeds of server/presets.
const char* presets_text();          ///< presets.txtpb
const char* materials_text();        ///< materials.txtpb
const char* measured_errors_text();  ///< measured_errors.csv
const char* small_specimens_text();  ///< small_specimens.csv
const char* default_meshes_text();   ///< default_meshes.csv

/// A preset with its complete case, and what the case means.
struct Preset {
  v1::Preset message;
  SceneSpec spec;
};

/// All presets, in the order they are listed in.
const std::vector<Preset>& presets();

/// The preset with that name, or null.
const Preset* find_preset(const std::string& name);

}  // namespace cellcrush::translate
