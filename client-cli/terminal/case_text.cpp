#include "terminal/case_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "command_error.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

using Align = Table::Align;

std::string error_text(const v1::MeasuredError& error) {
  return unbreakable(percent_text(error.error_relative())) + ' ' +
         unbreakable("± " + percent_text(error.uncertainty_relative()));
}

// The forecast that names the scenes in which errors were measured; null if the case's own fields determine everything.
const v1::FidelityForecast* find_measured(const v1::CheckCaseResponse& check) {
  for (const v1::FidelityForecast& forecast : check.fidelities()) {
    if (forecast.errors_size() > 0) return &forecast;
  }
  return nullptr;
}

std::string given_text(const v1::FidelityForecast& forecast) {
  return printable(fmt::format("{}", fmt::join(forecast.given_fields(), ", ")));
}

std::vector<std::string> row_of(const v1::FidelityForecast& forecast) {
  std::vector<std::string> row = {v1::Numerics::Fidelity_Name(forecast.fidelity()),
                                  fmt::format("{}", forecast.elements_per_wall()),
                                  duration_text(forecast.predicted_seconds())};
  for (const v1::MeasuredError& error : forecast.errors()) row.push_back(error_text(error));
  if (forecast.errors_size() == 0) row.emplace_back("not known");
  return row;
}

// Whether the case's own fields leave nothing for a fidelity to set.
bool are_all_the_same(const v1::CheckCaseResponse& check) {
  return std::all_of(check.fidelities().begin(), check.fidelities().end(), [&](const v1::FidelityForecast& forecast) {
    return forecast.elements_per_wall() == check.fidelities(0).elements_per_wall();
  });
}

// Why no error is known, and how to find it out.
std::string unknown_text(const v1::CheckCaseResponse& check) {
  const std::string given = given_text(check.fidelities(0));
  return "The mesh error is not known" +
         (given.empty() ? "." : ", because the case differs from every measured preset in " + given + '.') +
         " `cellcrush converge` estimates it.";
}

std::string scatter_text(const v1::FidelityForecast& measured) {
  std::string text;
  for (const v1::MeasuredError& error : measured.errors()) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", percent_text(error.scatter_relative()),
                        printable(error.measure()));
  }
  return text;
}

constexpr int kHeadingWidth = 78;  // behind the "# " of a comment

// Fields of a crush that a frame with its own loads lacks.
void add_crush_rows(Table& table, const v1::CheckCaseResponse& check) {
  table.add({"length (crush direction)", number_text(check.length_mm(), 4), "mm"});
  table.add({"width (transverse)", number_text(check.width_mm(), 4), "mm"});
  table.add({"relative density", number_text(100 * check.relative_density()), "%"});
  if (check.has_valid_to_strain())
    table.add({"valid to strain", number_text(check.valid_to_strain()), "closed from there on"});
}

}  // namespace

std::string fidelity_text(const v1::CheckCaseResponse& check, int width) {
  if (check.fidelities_size() == 0) return {};
  const v1::FidelityForecast* measured = find_measured(check);
  if (are_all_the_same(check) && measured == nullptr) {
    return '\n' + wrapped(
                      "cost and accuracy: numerics.fidelity changes nothing, because the case sets "
                      "elements_per_wall. " +
                          unknown_text(check),
                      width);
  }
  std::vector<std::string> heading = {"fidelity", "elements per wall", "predicted time"};
  std::vector<Align> columns = {Align::left, Align::right, Align::right};
  if (measured != nullptr) {
    for (const v1::MeasuredError& error : measured->errors()) heading.push_back(printable(error.measure()));
  } else {
    heading.push_back("error");
  }
  columns.resize(heading.size(), Align::left);
  Table table(columns);
  table.add(heading);
  for (const v1::FidelityForecast& forecast : check.fidelities()) table.add(row_of(forecast));
  std::string text = "\ncost and accuracy by numerics.fidelity\n" + table.text(2, width);
  if (measured != nullptr) {
    text +=
        wrapped(fmt::format("An error is the difference of the mean over seeds from the limit of infinitely fine "
                            "meshes, ± the half-width of the limit's interval. Single {} runs scatter by {} between "
                            "seeds.",
                            v1::Numerics::Fidelity_Name(measured->fidelity()), scatter_text(*measured)),
                width, "  ", "  ");
  } else {
    text += wrapped(unknown_text(check), width, "  ", "  ");
  }
  return text;
}

bool has_support(const v1::Job& job) {
  const auto is_side = [](const v1::RigidWallSummary& wall) { return wall.wall().starts_with("side_"); };
  return job.words().plates() || std::ranges::count_if(job.summary().rigid_walls(), std::not_fn(is_side)) != 1;
}

std::string scene_text(const v1::CaseWords& words) {
  return words.lattice() + (words.lattice().empty() || words.loading().empty() ? "" : ", ") + words.loading();
}

std::string facts_text(const v1::CaseWords& words, int width) {
  Table table({Align::left, Align::left});
  for (const auto& fact : words.facts()) table.add({fact.heading(), fact.text()});
  return table.text(2, width);
}

std::string check_text(const v1::CheckCaseResponse& check, int width) {
  Table table({Align::left, Align::right, Align::left});
  table.add({"particles", count_text(check.particle_count())});
  table.add({"elements", count_text(check.element_count())});
  table.add({check.completed_case().lattice().has_frame() ? "mass of the beams" : "mass of the walls",
             number_text(check.mass_g(), 4), "g"});
  if (has_strain(check.words())) add_crush_rows(table, check);
  table.add({"stable step", number_text(check.stable_step_s(), 4), "s"});
  table.add({"time step", number_text(check.time_step_s(), 4), "s"});
  table.add({"steps", count_text(check.step_count())});
  const bool ends_at_rest = check.completed_case().loading().end_at_rest() > 0;
  table.add({"predicted time", duration_text(check.predicted_seconds()), ends_at_rest ? "up to its end time" : ""});
  table.add({"predicted result file", size_text(check.predicted_bytes())});
  if (check.predicted_disk_bytes() > 0) table.add({"predicted disk space", size_text(check.predicted_disk_bytes())});
  if (check.predicted_memory_bytes() > 0) table.add({"predicted memory", size_text(check.predicted_memory_bytes())});
  if (check.theory().has_modulus_mpa()) {
    const v1::Theory& theory = check.theory();
    const ShownUnit unit = unit_by_size("MPa", theory.modulus_mpa());
    table.add({"theory: elastic modulus", number_text(unit.factor * theory.modulus_mpa()),
               fmt::format("{} (across the crush {})", unit.name, quantity_text(theory.modulus_across_mpa(), "MPa"))});
    table.add({"theory: Poisson's ratio", number_text(theory.poissons_ratio()),
               fmt::format("elastic (across the crush {})", number_text(theory.poissons_ratio_across()))});
  }
  if (has_strain(check.words()) && check.theory().gibson_ashby_mpa() <= 0)
    table.add({"theory: quasi-static, shock", "none", "applies"});
  if (check.theory().gibson_ashby_mpa() > 0) {
    const ShownUnit stress = unit_by_size("MPa", check.theory().shock_mpa());
    table.add({"theory: quasi-static (Gibson-Ashby)", number_text(stress.factor * check.theory().gibson_ashby_mpa()),
               stress.name});
    table.add({"theory: shock (Eq. 51)", number_text(stress.factor * check.theory().shock_mpa()), stress.name});
    table.add({"theory: densification strain", number_text(check.theory().densification_strain())});
  }
  const v1::Case& completed = check.completed_case();
  std::string text;
  if (!completed.title().empty()) text += wrapped(printable(completed.title()), width);
  if (const std::string scene = scene_text(check.words()); !scene.empty()) text += wrapped(printable(scene), width);
  if (const std::string facts = facts_text(check.words(), width); !facts.empty()) text += '\n' + facts;
  if (!text.empty()) text += '\n';
  text += table.text(2, width);
  if (check.notes_size() > 0) text += '\n' + notes_text(check.notes());
  const std::string& note = check.words().theory_note();
  if (!note.empty()) text += '\n' + wrapped("Note: " + printable(note), width, "  ", "  ");
  if (!check.small_specimen().empty()) text += '\n' + wrapped(printable(check.small_specimen()), width, "  ", "  ");
  if (!check.default_mesh().empty()) text += '\n' + wrapped(printable(check.default_mesh()), width, "  ", "  ");
  text += fidelity_text(check, width);
  if (check.modelled_size() > 0) text += "\nmodel and simplifications\n";
  for (const std::string& sentence : check.modelled()) text += wrapped(printable(sentence), width, "  - ", "    ");
  return text;
}

std::string case_file_text(const v1::Case& contents, const std::string& heading) {
  std::string text;
  std::istringstream lines(heading);
  for (std::string line; std::getline(lines, line);)
    text += line.empty() ? "#\n" : fmt::format("# {}\n", printable(line));
  v1::Case known = contents;
  known.DiscardUnknownFields();
  if (known.ByteSizeLong() != contents.ByteSizeLong())
    text += "#\n# Fields by number are those of a newer server. To use this file, take the cellcrush of its version.\n";
  google::protobuf::TextFormat::Printer printer;
  printer.SetUseUtf8StringEscaping(true);
  std::string body;
  printer.PrintToString(contents, &body);
  return text + '\n' + body;
}

std::string preset_heading(const v1::Preset& preset) {
  std::string heading = "preset:" + preset.name() + '\n' + wrapped(preset.title(), kHeadingWidth);
  if (preset.assumptions_size() > 0) heading += "\nAssumptions:\n";
  for (const std::string& assumption : preset.assumptions())
    heading += wrapped(assumption, kHeadingWidth, "  - ", "    ");
  return heading;
}

std::string material_list_text(const v1::ListMaterialsResponse& materials, int width) {
  std::string text;
  for (const v1::NamedMaterial& material : materials.materials()) {
    text += (text.empty() ? "\"" : "\n\"") + material.name() + "\"  " + material.title() + '\n' +
            wrapped(material.numbers(), width, "  ", "  ");
    for (const std::string& source : material.sources()) text += wrapped(source, width, "  - ", "    ");
  }
  return text;
}

std::string preset_list_text(const v1::ListPresetsResponse& presets, int width) {
  Table table({Align::left, Align::left});
  for (const v1::Preset& preset : presets.presets()) table.add({"preset:" + preset.name(), preset.title()});
  return table.text(0, width);
}

}  // namespace cellcrush::client
