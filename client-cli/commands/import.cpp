#include <fmt/format.h>
#include <google/protobuf/text_format.h>

#include <filesystem>

#include "case_file/case_source.h"
#include "case_file/drawn_lattice.h"
#include "commands/commands.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

struct ImportOptions {
  DrawingOptions drawing;
  std::string output;
  std::string base;
};

ExitCode run_import(Session& session, const ImportOptions& options) {
  const v1::ImportLatticeResponse drawn = read_drawn_lattice(options.drawing);
  v1::Case out;
  if (!options.base.empty()) out = read_case({.source = options.base}, session.connection());
  out.set_title(std::filesystem::path(options.drawing.files.front()).stem().string());
  replace_lattice(drawn.network(), out);
  google::protobuf::TextFormat::Printer printer;
  printer.SetUseShortRepeatedPrimitives(true);
  std::string text;
  printer.PrintToString(out, &text);
  write_file(options.output, text);
  if (session.json) {
    print_json(drawn.report());
  } else {
    for (const std::string& line : drawn.report().lines()) fmt::print("{}\n", line);
  }
  return ExitCode::done;
}

}  // namespace

void add_import_command(CLI::App& app, Session& session) {
  const auto [command, options] =
      add_command<ImportOptions>(app, session, kCaseCommands, "import",
                                 "Make a case of a drawing: CSV, JSON, DXF, SVG, Abaqus or Gmsh", run_import);
  command->add_option("FILE", options->drawing.files, "The drawing; of CSV also two files, nodes and edges")
      ->required();
  add_option(*command, kOutputOptions, "-o,--output", options->output, "File of the case")->required();
  add_option(*command, kCaseOptions, "--case", options->base,
             "Case from which all but the walls is taken: a file or preset:NAME (default: none)");
  add_drawing_options(*command, options->drawing);
  add_examples(*command,
               {"cellcrush import foam.csv --unit mm --thickness 0.2 --case preset:hexagon-small -o foam.txtpb"});
}

}  // namespace cellcrush::client
