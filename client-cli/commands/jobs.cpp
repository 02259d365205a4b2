#include <fmt/format.h>

#include "commands/commands.h"
#include "commands/resource_name.h"
#include "terminal/json_text.h"
#include "terminal/sweep_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

template <typename Request>
using JobMethod = grpc::Status (v1::Jobs::Stub::*)(grpc::ClientContext*, const Request&, v1::Job*);

// Calls a method on a job and prints the job's new state.
template <typename Request>
void change_job(Session& session, const std::string& name, JobMethod<Request> method) {
  Connection& connection = session.connection();
  Request request;
  request.set_name(job_name(name));
  const v1::Job job = connection.call(connection.jobs(), method, request);
  session.json ? print_json(job) : fmt::print("{} {}\n", printable(job.name()), v1::Job::State_Name(job.state()));
}

void cancel_sweep(Session& session, const std::string& name) {
  Connection& connection = session.connection();
  v1::CancelSweepRequest request;
  request.set_name(name);
  const v1::Sweep sweep = connection.call(connection.sweeps(), &v1::Sweeps::Stub::CancelSweep, request);
  session.json ? print_json(sweep) : fmt::print("{}", sweep_line(sweep));
}

CLI::App* add_named_command(CLI::App& app, Session& session, const char* command_name, const char* description,
                            const char* name_help, void (*action)(Session&, const std::string&)) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, command_name, description, [&session, name, action] {
    action(session, *name);
    return ExitCode::done;
  });
  command->group(kJobCommands);
  command->add_option("NAME", *name, name_help)->required();
  return command;
}

}  // namespace

void add_job_commands(CLI::App& app, Session& session) {
  CLI::App* cancel =
      add_named_command(app, session, "cancel", "Cancel a job, or all jobs of a sweep; results so far are kept",
                        "Name of a job or a sweep", [](Session& s, const std::string& name) {
                          names_sweep(name) ? cancel_sweep(s, name) : change_job(s, name, &v1::Jobs::Stub::CancelJob);
                        });
  add_examples(*cancel, {"cellcrush cancel jobs/12", "cellcrush cancel sweeps/3"});
  CLI::App* suspend =
      add_named_command(app, session, "suspend", "Stop a job at a checkpoint; resume continues it", "Job name",
                        [](Session& s, const std::string& name) { change_job(s, name, &v1::Jobs::Stub::SuspendJob); });
  add_examples(*suspend, {"cellcrush suspend jobs/12"});
  CLI::App* resume =
      add_named_command(app, session, "resume", "Continue a suspended job", "Job name",
                        [](Session& s, const std::string& name) { change_job(s, name, &v1::Jobs::Stub::ResumeJob); });
  add_examples(*resume, {"cellcrush resume jobs/12"});
}

}  // namespace cellcrush::client
