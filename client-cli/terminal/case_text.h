#pragma once

#include <string>

#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// Predicted cost and error of a case at each fidelity, as a table with a line about the errors; empty without
/// fidelities.
std::string fidelity_text(const v1::CheckCaseResponse& check, int width);

/// Whether a crush has strain and stresses: between plates, or between two rigid walls in their place.
inline bool has_strain(const v1::CaseWords& words) { return words.plates() || words.rigid_wall_plates(); }

/// Whether a lattice is crushed against something: one rigid wall without plates crushes against nothing.
bool has_support(const v1::Job& job);

/// Summary of a case in one line: "hexagons, 74 x 21 cells, crushed along X at 100 m/s to strain 0.8".
std::string scene_text(const v1::CaseWords& words);

/// Contents of a case, one line per heading; empty if there are none.
std::string facts_text(const v1::CaseWords& words, int width = terminal_width());

/// The predicted cost of a case as a table with units, and what is modelled.
std::string check_text(const v1::CheckCaseResponse& check, int width = terminal_width());

/// A case as protobuf text that can be read back, preceded by `heading` as comment lines.
std::string case_file_text(const v1::Case& contents, const std::string& heading);

/// Header of a preset's case file: name, title and assumptions.
std::string preset_heading(const v1::Preset& preset);

/// The named materials, with numbers and sources.
std::string material_list_text(const v1::ListMaterialsResponse& materials, int width = terminal_width());

/// The presets, one row each.
std::string preset_list_text(const v1::ListPresetsResponse& presets, int width = terminal_width());

}  // namespace cellcrush::client
