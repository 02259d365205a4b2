#include <fmt/format.h>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "connection/pages.h"
#include "terminal/case_text.h"
#include "terminal/job_text.h"
#include "terminal/json_text.h"
#include "terminal/sweep_text.h"

namespace cellcrush::client {

namespace {

void show_preset(Session& session, const std::string& name) {
  Connection& connection = session.connection();
  v1::GetPresetRequest request;
  request.set_name(name);
  const auto preset = connection.call(connection.cases(), &v1::Cases::Stub::GetPreset, request);
  session.json ? print_json(preset) : fmt::print("{}", case_file_text(preset.case_(), preset_heading(preset)));
}

void show_job(Session& session, const std::string& name) {
  Connection& connection = session.connection();
  v1::GetJobRequest request;
  request.set_name(job_name(name));
  const auto job = connection.call(connection.jobs(), &v1::Jobs::Stub::GetJob, request);
  session.json ? print_json(job) : fmt::print("{}", description_text(job));
}

void show_sweep(Session& session, const std::string& name) {
  const auto sweep = fetch_sweep(session.connection(), name);
  session.json ? print_json(sweep) : fmt::print("{}", description_text(sweep));
}

}  // namespace

void add_show_command(CLI::App& app, Session& session) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(
      app, session, "show", "Print a preset as a complete case file, or describe a job or a sweep", [&session, name] {
        if (const std::string preset = preset_name(*name); !preset.empty()) {
          show_preset(session, preset);
        } else {
          names_sweep(*name) ? show_sweep(session, *name) : show_job(session, *name);
        }
        return ExitCode::done;
      });
  command->group(kCaseCommands);
  command->add_option("NAME", *name, "preset:NAME, or the name of a job or a sweep")->required();
  add_examples(*command, {"cellcrush show preset:type-i > my.txtpb", "cellcrush show jobs/12"});
}

}  // namespace cellcrush::client
