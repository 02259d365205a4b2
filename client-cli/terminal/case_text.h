#pragma once

#include <string>

#include "cellcrush/v1/cases_service.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// What a case is, in a line: "hexagons, 74 x 21 cells, crushed along X at 100 m/s to strain 0.8".
std::string scene_text(const v1::Case& scene);

/// What a case is made of, a line a heading: its lattice or frame, material and friction. Empty for an empty case.
std::string description_text(const v1::Case& scene, int width = terminal_width());

/// What running a case takes, as a table with units, and what is modelled.
std::string check_text(const v1::CheckCaseResponse& check, int width = terminal_width());

/// A case as protobuf text that can be read back, below comment lines with `heading`, a line for each of its lines.
std::string case_file_text(const v1::Case& contents, const std::string& heading);

/// What a preset's case file begins with: name, title and assumptions.
std::string preset_heading(const v1::Preset& preset);

/// The presets, a row each.
std::string preset_list_text(const v1::ListPresetsResponse& presets, int width = terminal_width());

}  // namespace cellcrush::client
