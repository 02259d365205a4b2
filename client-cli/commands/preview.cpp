#include <fmt/format.h>

#include <filesystem>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "drawing/drawing.h"
#include "drawing/lattice_marks.h"
#include "plots/preview_picture.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {
namespace {

/// Gives a drawing that has no case its material, depth and plates.
constexpr const char* kCaseOfDrawings = "preset:hexagon-small";

struct PreviewOptions {
  CaseOptions scene;
  std::string file;
};

/// Of the places that import has found, those where it left something out.
void add_left_out(const v1::ImportReport& report, v1::PreviewCaseResponse& preview) {
  for (const v1::LatticeMarks& marks : report.marks()) {
    if (marks.kind() == v1::LatticeMarks::DUPLICATE || marks.kind() == v1::LatticeMarks::COVERED) {
      *preview.add_marks() = marks;
    }
  }
}

ExitCode run_preview(Session& session, PreviewOptions options) {
  const PictureFormat format = picture_format(options.file);
  std::string title;
  if (drawing::names_drawing(options.scene.source)) {
    options.scene.lattice.files.insert(options.scene.lattice.files.begin(), options.scene.source);
    options.scene.source = kCaseOfDrawings;
  }
  if (!options.scene.lattice.files.empty()) {
    title = std::filesystem::path(options.scene.lattice.files.front()).filename().string();
  }
  session.use_private_server();
  Connection& connection = session.connection();
  v1::ImportReport report;
  v1::PreviewCaseRequest request;
  *request.mutable_case_() = read_case(options.scene, connection, &report);
  if (title.empty()) title = request.case_().title().empty() ? options.scene.source : request.case_().title();
  auto preview = connection.call(connection.cases(), &v1::Cases::Stub::PreviewCase, request, kCheckPatience);
  add_left_out(report, preview);
  write_file(options.file, render_preview_picture(format, title, preview, RigidWalls(request.case_(), {})));
  preview.clear_mesh();
  if (session.json) {
    print_json(preview);
    return ExitCode::done;
  }
  if (report.lines_size() > 0) fmt::print("{}\n", report.lines(0));
  for (const v1::LatticeMarks& marks : preview.marks()) fmt::print("  {}\n", drawing::marks_text(marks));
  fmt::print("{}\n", options.file);
  if (preview.problems_size() > 0) {
    v1::ProblemList problems;
    *problems.mutable_problems() = preview.problems();
    fmt::print(stderr, "The case cannot run:\n{}", problems_text(problems));
  }
  return ExitCode::done;
}

}  // namespace

void add_preview_command(CLI::App& app, Session& session) {
  const auto [command, options] = add_command<PreviewOptions>(
      app, session, kCaseCommands, "preview",
      "Draw a case before it runs, with the faults of its lattice; needs no daemon", run_preview);
  add_case_options(*command, options->scene);
  command->get_option("CASE")->description(
      "A case file, - for stdin, or preset:NAME; or a drawing, between the plates of preset:hexagon-small");
  add_option(*command, kOutputOptions, "-o,--output", options->file, "Picture file: FILE.svg, FILE.pdf or FILE.png")
      ->required();
  add_examples(*command, {"cellcrush preview my.txtpb -o lattice.svg",
                          "cellcrush preview foam.csv --unit mm --thickness 0.2 -o foam.png"});
}

}  // namespace cellcrush::client
