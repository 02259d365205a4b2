#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <filesystem>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "drawing/drawing.h"
#include "drawing/join_walls.h"
#include "drawing/units.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

struct ImportOptions {
  std::vector<std::string> files;
  std::string output;
  std::string base;
  std::string unit;
  std::optional<double> thickness;
  std::optional<double> tolerance;
  double bond = kBondTolerance;
  bool keeps_crossings = false;
};

double mm_of_unit(const ImportOptions& options, const Drawing& drawing) {
  if (!options.unit.empty()) return mm_per(options.unit);
  if (drawing.mm_per_unit) return *drawing.mm_per_unit;
  refuse(fmt::format("{} does not tell its unit of length. Give it with --unit, such as --unit mm.",
                     options.files.front()));
}

std::string places_text(const std::vector<DrawnPlace>& places) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), kShown); ++i) {
    text += fmt::format("{}({:.6g}, {:.6g})", i == 0 ? "" : ", ", places[i].x, places[i].y);
  }
  return places.size() > kShown ? text + fmt::format(" and {} more", places.size() - kShown) : text;
}

std::vector<DrawnPlace> middles_of(const std::vector<Bond>& bonds) {
  std::vector<DrawnPlace> middles;
  for (const Bond& bond : bonds) middles.push_back(bond.middle);
  return middles;
}

/// What was read and done, a line each.
std::string report_text(const Drawing& drawing, const JoinedWalls& joined, double mm) {
  std::string text = fmt::format("{} walls between {} joints, 1 unit of the file = {:.6g} mm\n",
                                 joined.network.walls_size() / 2, joined.network.joints_mm_size() / 2, mm);
  const auto tell = [&text](bool is_so, const std::string& line) {
    if (is_so) text += "  " + line + "\n";
  };
  tell(joined.merged > 0, fmt::format("{} ends merged within {:.3g} mm", joined.merged, joined.tolerance_mm));
  tell(!joined.bonds.empty(),
       fmt::format("{} pairs of walls face to face: bonded into one of both thicknesses, at {} mm", joined.bonds.size(),
                   places_text(middles_of(joined.bonds))));
  tell(joined.divided > 0, fmt::format("{} ends met a wall between its joints: joined there", joined.divided));
  tell(!joined.crossings.empty(),
       fmt::format("{} crossings of walls, at {} mm", joined.crossings.size(), places_text(joined.crossings)));
  tell(joined.duplicates > 0, fmt::format("{} walls were there twice: left out", joined.duplicates));
  tell(!joined.lengths.empty(), fmt::format("{} lines without length: left out", joined.lengths.size()));
  tell(!joined.loose.empty(), fmt::format("{} loose ends, at {} mm", joined.loose.size(), places_text(joined.loose)));
  for (std::size_t i = 0; i < joined.islands.size(); ++i) {
    tell(i < 5, fmt::format("an island of {} walls, at ({:.6g}, {:.6g}) mm", joined.island_walls[i],
                            joined.islands[i].x, joined.islands[i].y));
  }
  for (const std::string& what : drawing.left_out) tell(true, what + ": no walls, left out");
  return text;
}

google::protobuf::Struct report_json(const Drawing& drawing, const JoinedWalls& joined, double mm) {
  google::protobuf::Struct json;
  auto& members = *json.mutable_fields();
  const auto count = [&members](const char* name, double value) { members[name].set_number_value(value); };
  const auto places = [&members](const char* name, const std::vector<DrawnPlace>& list) {
    auto& values = *members[name].mutable_list_value();
    for (const DrawnPlace& place : list) {
      auto& pair = *values.add_values()->mutable_list_value();
      pair.add_values()->set_number_value(place.x);
      pair.add_values()->set_number_value(place.y);
    }
  };
  count("walls", joined.network.walls_size() / 2);
  count("joints", joined.network.joints_mm_size() / 2);
  count("mm_per_unit", mm);
  count("tolerance_mm", joined.tolerance_mm);
  count("merged", joined.merged);
  count("divided", joined.divided);
  count("duplicates", joined.duplicates);
  count("without_length", static_cast<double>(joined.lengths.size()));
  places("bonds_mm", middles_of(joined.bonds));
  places("crossings_mm", joined.crossings);
  places("loose_mm", joined.loose);
  places("islands_mm", joined.islands);
  auto& left_out = *members["left_out"].mutable_list_value();
  for (const std::string& what : drawing.left_out) left_out.add_values()->set_string_value(what);
  return json;
}

ExitCode run_import(Session& session, const ImportOptions& options) {
  const Drawing drawing = read_drawing(options.files);
  const double mm = mm_of_unit(options, drawing);
  const JoinedWalls joined =
      join_walls(drawing, {mm, options.tolerance, options.thickness, options.bond, !options.keeps_crossings});
  v1::Case out;
  if (!options.base.empty()) out = read_case(options.base, {}, session.connection());
  out.set_title(std::filesystem::path(options.files.front()).stem().string());
  out.mutable_lattice()->clear_inclusions();
  *out.mutable_lattice()->mutable_network() = joined.network;
  google::protobuf::TextFormat::Printer printer;
  printer.SetUseShortRepeatedPrimitives(true);
  std::string text;
  printer.PrintToString(out, &text);
  write_file(options.output, text);
  session.json ? print_json(report_json(drawing, joined, mm)) : fmt::print("{}", report_text(drawing, joined, mm));
  return ExitCode::done;
}

}  // namespace

void add_import_command(CLI::App& app, Session& session) {
  const auto [command, options] =
      add_command<ImportOptions>(app, session, kCaseCommands, "import",
                                 "Make a case of a drawing: CSV, JSON, DXF, SVG, Abaqus or Gmsh", run_import);
  command->add_option("FILE", options->files, "The drawing; of CSV also two files, nodes and edges")->required();
  add_option(*command, kOutputOptions, "-o,--output", options->output, "File of the case")->required();
  add_option(*command, kCaseOptions, "--case", options->base,
             "Case from which all but the walls is taken: a file or preset:NAME (default: none)");
  add_option(*command, kCaseOptions, "--unit", options->unit,
             "Unit of the file: mm, cm, m, um, in, ft, pt or px (default: as the file tells)");
  add_option(*command, kCaseOptions, "--thickness", options->thickness,
             "Thickness in mm of walls whose file does not tell it (default: none)");
  add_option(*command, kCaseOptions, "--tolerance", options->tolerance,
             "Distance in mm within which ends are one joint (default: a thousandth of the shortest wall)");
  add_option(*command, kCaseOptions, "--bond", options->bond,
             "Walls face to face, a thickness apart to within this share of it, become one wall of both; 0: they slide "
             "(default: 0.05)")
      ->check(CLI::Range(0.0, 0.5).description(""));
  add_option(*command, kCaseOptions, "--keep-crossings", options->keeps_crossings,
             "Do not join walls where they cross");
  add_examples(*command,
               {"cellcrush import foam.csv --unit mm --thickness 0.2 --case preset:hexagon-small -o foam.txtpb"});
}

}  // namespace cellcrush::client
