#include "terminal/case_text.h"

#include <fmt/format.h>
#include <google/protobuf/text_format.h>

#include <sstream>

#include "command_error.h"
#include "terminal/fidelity_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;

constexpr int kHeadingWidth = 78;  // behind the "# " of a comment

// Fields of a crush that a frame with its own loads lacks.
void add_crush_rows(Table& table, const v1::CheckCaseResponse& check) {
  table.add({"length (crush direction)", number_text(check.length_mm(), 4), "mm"});
  table.add({"width (transverse)", number_text(check.width_mm(), 4), "mm"});
  table.add({"relative density", number_text(100 * check.relative_density()), "%"});
}

}  // namespace

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
  if (check.words().plates()) add_crush_rows(table, check);
  table.add({"stable step", number_text(check.stable_step_s(), 4), "s"});
  table.add({"time step", number_text(check.time_step_s(), 4), "s"});
  table.add({"steps", count_text(check.step_count())});
  table.add({"predicted time", duration_text(check.predicted_seconds())});
  table.add({"predicted result file", size_text(check.predicted_bytes())});
  if (check.predicted_memory_bytes() > 0) table.add({"predicted memory", size_text(check.predicted_memory_bytes())});
  if (check.theory().gibson_ashby_mpa() > 0) {
    table.add({"theory: quasi-static (Gibson-Ashby)", number_text(check.theory().gibson_ashby_mpa()), "MPa"});
    table.add({"theory: shock (Eq. 51)", number_text(check.theory().shock_mpa()), "MPa"});
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
  if (!note.empty() && check.theory().shock_mpa() > 0)
    text += '\n' + wrapped("Note: " + printable(note), width, "  ", "  ");
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

std::string preset_list_text(const v1::ListPresetsResponse& presets, int width) {
  Table table({Align::left, Align::left});
  for (const v1::Preset& preset : presets.presets()) table.add({"preset:" + preset.name(), preset.title()});
  return table.text(0, width);
}

}  // namespace cellcrush::client
