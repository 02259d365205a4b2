#include <fmt/format.h>

#include "commands/commands.h"
#include "commands/confirmation.h"
#include "commands/resource_name.h"
#include "terminal/json_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

struct DeleteOptions {
  std::string name;
  bool yes = false;
};

std::string job_question(Connection& connection, const std::string& name) {
  v1::GetJobRequest request;
  request.set_name(name);
  const v1::Job job = connection.call(connection.jobs(), &v1::Jobs::Stub::GetJob, request);
  const std::string title = job.case_().title().empty() ? "" : ", " + printable(job.case_().title());
  return fmt::format("Delete {} ({}{}) and its results?", name, v1::Job::State_Name(job.state()), title);
}

std::string sweep_question(Connection& connection, const std::string& name) {
  v1::GetSweepRequest request;
  request.set_name(name);
  const v1::Sweep sweep = connection.call(connection.sweeps(), &v1::Sweeps::Stub::GetSweep, request);
  return fmt::format("Delete {} with its {} jobs and their results?", name, sweep.jobs_size());
}

// Asks for confirmation and calls the method, whose request has a name and whose response is empty.
template <typename Stub, typename Request, typename Response>
ExitCode ask_and_delete(Session& session, Stub& stub,
                        grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                        const std::string& name, bool yes, std::string (*question)(Connection&, const std::string&)) {
  Connection& connection = session.connection();
  if (!yes && !confirm([&] { return question(connection, name); })) {
    throw CommandError(ExitCode::refused, name + " was not deleted");
  }
  Request request;
  request.set_name(name);
  const Response response = connection.call(stub, method, request);
  session.json ? print_json(response) : fmt::print("{} deleted\n", name);
  return ExitCode::done;
}

ExitCode run_delete(Session& session, const DeleteOptions& options) {
  Connection& connection = session.connection();
  if (names_sweep(options.name)) {
    return ask_and_delete(session, connection.sweeps(), &v1::Sweeps::Stub::DeleteSweep, options.name, options.yes,
                          sweep_question);
  }
  return ask_and_delete(session, connection.jobs(), &v1::Jobs::Stub::DeleteJob, job_name(options.name), options.yes,
                        job_question);
}

}  // namespace

void add_delete_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<DeleteOptions>();
  CLI::App* command = add_command(app, session, "delete", "Delete a job, or a sweep with all its jobs; asks first",
                                  [&session, options] { return run_delete(session, *options); });
  command->group(kJobCommands);
  command->add_option("NAME", options->name, "Job name, or sweeps/NAME")->required();
  command->add_flag("-y,--yes", options->yes,
                    "Delete without asking, as also happens when standard input is not a terminal");
  add_examples(*command, {"cellcrush delete jobs/12", "cellcrush delete sweeps/3 --yes"});
}

}  // namespace cellcrush::client
