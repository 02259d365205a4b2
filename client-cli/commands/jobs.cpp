#include <fmt/format.h>
#include <unistd.h>

#include <functional>
#include <iostream>
#include <string>

#include "commands/commands.h"
#include "connection/connection.h"
#include "terminal/sweep_text.h"
#include "terminal/table.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

template <typename Request>
using JobMethod = grpc::Status (v1::Jobs::Stub::*)(grpc::ClientContext*, const Request&, v1::Job*);

// Calls a method on a job and prints the job's new state.
template <typename Request>
void change_job(Session& session, const std::string& name, JobMethod<Request> method) {
  Connection& connection = session.connection();
  const v1::Job job = connection.call_for(job_name(name), connection.jobs(), method);
  session.json ? print_json(job) : fmt::print("{} {}\n", printable(job.name()), v1::Job::State_Name(job.state()));
}

template <typename Request>
using SweepMethod = grpc::Status (v1::Sweeps::Stub::*)(grpc::ClientContext*, const Request&, v1::Sweep*);

// The same for a sweep.
template <typename Request>
void change_sweep(Session& session, const std::string& name, SweepMethod<Request> method) {
  Connection& connection = session.connection();
  const v1::Sweep sweep = connection.call_for(sweep_name(name), connection.sweeps(), method);
  session.json ? print_json(sweep) : fmt::print("{}", sweep_line(sweep));
}

CLI::App* add_named_command(CLI::App& app, Session& session, const char* command_name, const char* description,
                            const char* argument, const char* name_help, void (*action)(Session&, const std::string&)) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, kJobCommands, command_name, description, [&session, name, action] {
    action(session, *name);
    return ExitCode::done;
  });
  command->add_option(argument, *name, name_help)->required();
  return command;
}

// Asks `question`; returns whether the user answers "y" or "yes". Asks on stderr if stdin and stderr are terminals.
// Otherwise, as in a script, it returns true without asking.
bool confirm(const std::function<std::string()>& question) {
  if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1) return true;
  fmt::print(stderr, "{} [y/N] ", question());
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

struct NoteOptions {
  std::string name;
  std::string text;
};

// Writes the note of a job or a sweep in place of that in `before`; `target` is the part of the request for it.
template <typename Stub, typename Request, typename Resource>
ExitCode write_note(Session& session, Stub& stub,
                    grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Resource*),
                    Resource* (Request::*target)(), const Resource& before, const std::string& text) {
  Request request;
  (request.*target)()->set_name(before.name());
  (request.*target)()->set_note(text);
  request.mutable_update_mask()->add_paths("note");
  request.set_previous_note(before.note());
  const Resource after = session.connection().call(stub, method, request);
  if (session.json) {
    print_json(after);
    return ExitCode::done;
  }
  const bool has_replaced = !before.note().empty() && before.note() != after.note();
  fmt::print("{}{}\n{}", printable(after.name()),
             after.note().empty() ? " has no note" : ": " + printable(after.note()),
             has_replaced ? "Replaced: " + printable(before.note()) + '\n' : "");
  return ExitCode::done;
}

ExitCode run_note(Session& session, const NoteOptions& options) {
  Connection& connection = session.connection();
  if (names_sweep(options.name)) {
    return write_note(session, connection.sweeps(), &v1::Sweeps::Stub::UpdateSweep,
                      &v1::UpdateSweepRequest::mutable_sweep, fetch_sweep(connection, options.name), options.text);
  }
  return write_note(session, connection.jobs(), &v1::Jobs::Stub::UpdateJob, &v1::UpdateJobRequest::mutable_job,
                    fetch_job(connection, job_name(options.name)), options.text);
}

struct DeleteOptions {
  std::string name;
  bool yes = false;
};

std::string job_question(Connection& connection, const std::string& name) {
  const v1::Job job = fetch_job(connection, name);
  const std::string title = job.case_().title().empty() ? "" : ", " + printable(job.case_().title());
  return fmt::format("Delete {} ({}{}) and its results?", name, v1::Job::State_Name(job.state()), title);
}

std::string sweep_question(Connection& connection, const std::string& name) {
  const v1::Sweep sweep = fetch_sweep(connection, name);
  return fmt::format("Delete {} with its {} and all results?", name, job_count_text(sweep.jobs_size()));
}

// Asks for confirmation and calls the method, whose request has a name and whose response is empty.
template <typename Stub, typename Request, typename Response>
ExitCode ask_and_delete(Session& session, Stub& stub,
                        grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                        const std::string& name, bool yes, std::string (*question)(Connection&, const std::string&)) {
  Connection& connection = session.connection();
  if (!yes) {
    if (!confirm([&] { return question(connection, name); })) refuse(name + " was not deleted");
    connection.refresh();  // the answer may have taken hours
  }
  const Response response = connection.call_for(name, stub, method);
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

void add_job_commands(CLI::App& app, Session& session) {
  CLI::App* cancel =
      add_named_command(app, session, "cancel", "Cancel a job, or all jobs of a sweep; results so far are kept", "NAME",
                        "Name of a job or a sweep", [](Session& s, const std::string& name) {
                          names_sweep(name) ? change_sweep(s, name, &v1::Sweeps::Stub::CancelSweep)
                                            : change_job(s, name, &v1::Jobs::Stub::CancelJob);
                        });
  add_examples(*cancel, {"cellcrush cancel jobs/12", "cellcrush cancel sweeps/3"});
  CLI::App* suspend =
      add_named_command(app, session, "suspend", "Stop a job at a checkpoint; resume continues it", "NAME", "Job name",
                        [](Session& s, const std::string& name) { change_job(s, name, &v1::Jobs::Stub::SuspendJob); });
  add_examples(*suspend, {"cellcrush suspend jobs/12"});
  CLI::App* resume =
      add_named_command(app, session, "resume", "Continue a suspended job", "NAME", "Job name",
                        [](Session& s, const std::string& name) { change_job(s, name, &v1::Jobs::Stub::ResumeJob); });
  add_examples(*resume, {"cellcrush resume jobs/12"});
  CLI::App* retry = add_named_command(
      app, session, "retry", "Queue the failed jobs of a sweep again", "SWEEP", "Name of a sweep",
      [](Session& s, const std::string& name) { change_sweep(s, name, &v1::Sweeps::Stub::RetryFailedJobs); });
  add_examples(*retry, {"cellcrush retry sweeps/3"});
  const auto [note, note_options] = add_command<NoteOptions>(
      app, session, kJobCommands, "note", "Write a note on a job or a sweep, in place of its former one", run_note);
  note->add_option("NAME", note_options->name, "Name of a job or a sweep")->required();
  note->add_option("TEXT", note_options->text, "The note, up to 2000 bytes; '' removes it")->required();
  add_examples(*note, {"cellcrush note jobs/12 'buckled at the left first'", "cellcrush note sweeps/3 ''"});
  const auto [command, options] = add_command<DeleteOptions>(
      app, session, kJobCommands, "delete", "Delete a job, or a sweep with all its jobs; asks first", run_delete);
  command->add_option("NAME", options->name, "Job name, or sweeps/NAME")->required();
  command->add_flag("-y,--yes", options->yes,
                    "Delete without asking, as also happens when standard input is not a terminal");
  add_examples(*command, {"cellcrush delete jobs/12", "cellcrush delete sweeps/3 --yes"});
}

}  // namespace cellcrush::client
