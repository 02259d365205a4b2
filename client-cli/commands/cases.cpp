#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "terminal/case_text.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

ExitCode run_presets(Session& session) {
  Connection& connection = session.connection();
  const auto presets = connection.call(connection.cases(), &v1::Cases::Stub::ListPresets, v1::ListPresetsRequest());
  if (session.json) {
    print_json(presets);
  } else {
    fmt::print("{}", preset_list_text(presets));
  }
  return ExitCode::done;
}

ExitCode run_materials(Session& session) {
  Connection& connection = session.connection();
  const auto materials =
      connection.call(connection.cases(), &v1::Cases::Stub::ListMaterials, v1::ListMaterialsRequest());
  session.json ? print_json(materials) : fmt::print("{}", material_list_text(materials));
  return ExitCode::done;
}

ExitCode run_check(Session& session, const CaseOptions& options) {
  Connection& connection = session.connection();
  v1::CheckCaseRequest request;
  *request.mutable_case_() = read_case(options, connection);
  const auto check = connection.call(connection.cases(), &v1::Cases::Stub::CheckCase, request);
  if (check.problems_size() == 0) {
    session.json ? print_json(check) : fmt::print("{}", check_text(check));
    return ExitCode::done;
  }
  if (session.json) {
    print_json(check);
    return ExitCode::refused;
  }
  v1::ProblemList problems;
  *problems.mutable_problems() = check.problems();
  throw problems_error(std::move(problems));
}

}  // namespace

void add_case_commands(CLI::App& app, Session& session) {
  CLI::App* presets = add_command(app, session, kCaseCommands, "presets", "List the preset cases of the server",
                                  [&session] { return run_presets(session); });
  add_examples(*presets, {"cellcrush presets"});
  CLI::App* materials =
      add_command(app, session, kCaseCommands, "materials", "List the named materials of the server with their sources",
                  [&session] { return run_materials(session); });
  add_examples(*materials, {"cellcrush materials"});
  const auto [check, options] = add_command<CaseOptions>(
      app, session, kCaseCommands, "check", "Predict the cost of a case, or report all its problems", run_check);
  add_case_options(*check, *options);
  add_examples(*check, {"cellcrush check my.txtpb", "cellcrush check preset:type-i --set loading.speed_m_per_s=50"});
}

}  // namespace cellcrush::client
