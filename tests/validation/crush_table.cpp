#include "validation/crush_table.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "scenes/frames.h"

namespace cellcrush::validation {
namespace {

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

std::string text_of(const std::optional<double>& value) { return value ? text_of(*value) : ""; }

std::string hash_text(std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

Cells cells_of(const Options& options, const CrushRun& run) {
  const Summary& summary = run.summary;
  const auto front_text = [&](double FrontSummary::*measure) {
    return summary.front ? text_of((*summary.front).*measure) : std::string();
  };
  return {
      {"preset", options.preset},
      {"options", options.changes},
      {"status", scenes::name_of(run.status.kind)},
      {"end_strain", text_of(run.samples.back().strain)},
      {"plateau_stress_impact", text_of(summary.plateau_stress_impact)},
      {"plateau_stress_support", text_of(summary.plateau_stress_support)},
      {"plateau_stress_to_densification", text_of(summary.plateau_stress_to_densification)},
      {"limit_stress", text_of(run.limit.stress)},
      {"limit_strain", text_of(run.limit.strain)},
      {"least_stress_after_limit", text_of(run.limit.least_after)},
      {"densification_strain", text_of(summary.densification_strain)},
      {"absorbed_energy", text_of(summary.absorbed_energy)},
      {"energy_error_relative", text_of(summary.energy_error_relative)},
      {"deepest_penetration", text_of(summary.deepest_penetration)},
      {"deepest_birth", text_of(run.deepest_birth)},
      {"contact_work_share", text_of(run.contact_work_share)},
      {"plate_force_difference", text_of(run.plate_force_difference)},
      {"kinetic_over_work", text_of(run.kinetic_over_work)},
      {"kinetic_over_plastic", text_of(run.kinetic_over_plastic)},
      {"kinetic_over_plastic_flowing", text_of(run.kinetic_over_plastic_flowing)},
      {"crossings", std::to_string(run.crossings)},
      {"crush_mode", scenes::name_of(summary.crush_mode)},
      {"front_strain_behind", front_text(&FrontSummary::strain_behind)},
      {"front_strain_ahead", front_text(&FrontSummary::strain_ahead)},
      {"front_velocity_behind", front_text(&FrontSummary::velocity_behind)},
      {"front_velocity_ahead", front_text(&FrontSummary::velocity_ahead)},
      {"front_solid_fraction", front_text(&FrontSummary::solid_fraction_behind)},
      {"front_wall_fraction", front_text(&FrontSummary::wall_fraction_behind)},
      {"front_stress_ahead", front_text(&FrontSummary::stress_ahead)},
      {"front_shock", front_text(&FrontSummary::shock)},
      {"front_window_share", front_text(&FrontSummary::window_share)},
      {"theory_gibson_ashby", text_of(summary.theory.gibson_ashby)},
      {"theory_shock", text_of(summary.theory.shock)},
      {"time_step", text_of(run.facts.time_step)},
      {"steps", std::to_string(summary.step_count)},
      {"seconds", text_of(run.seconds)},
      {"state_hash", hash_text(run.state_hash)},
  };
}

}  // namespace

void append_row(const std::string& file, const Options& options, const CrushRun& run, const Cells& leading) {
  const bool is_new = !std::filesystem::exists(file) || std::filesystem::is_empty(file);
  std::ofstream stream(file, std::ios::app);
  Cells cells = leading;
  const Cells measures = cells_of(options, run);
  cells.insert(cells.end(), measures.begin(), measures.end());
  std::string names;
  std::string values;
  for (const auto& [name, value] : cells) {
    names += (names.empty() ? "" : ",") + name;
    values += (values.empty() ? "" : ",") + value;
  }
  // One write, so that two programs may append to the same file.
  stream << (is_new ? names + "\n" : "") + values + "\n" << std::flush;
  if (!stream) {
    throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
  }
}

std::string describe(const Options& options, const CrushRun& run) {
  std::string text;
  for (const auto& [name, value] : cells_of(options, run)) {
    text.append(name).append(34 - name.size(), ' ').append(value).append("\n");
  }
  return text + run.status.message;
}

}  // namespace cellcrush::validation
