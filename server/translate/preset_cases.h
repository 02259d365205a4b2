#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

/// All presets, in the order they are listed in, without their cases.
std::vector<v1::Preset> list_presets();

/// One preset with its complete case, or nothing.
std::optional<v1::Preset> find_preset_case(const std::string& name);

}  // namespace cellcrush::translate
