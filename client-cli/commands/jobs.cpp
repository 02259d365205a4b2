#include <fmt/format.h>

#include "commands/commands.h"
#include "terminal/job_text.h"
#include "terminal/json_text.h"

namespace cellcrush::client {

namespace {

struct ListOptions {
  std::string filter;
  std::string order;
};

ExitCode run_list(Session& session, const ListOptions& options) {
  constexpr int kPage = 1000;
  Connection& connection = session.connection();
  v1::ListJobsRequest request;
  request.set_page_size(kPage);
  request.set_filter(options.filter);
  request.set_order_by(options.order);
  v1::ListJobsResponse all;
  while (true) {
    auto page = connection.call(connection.jobs(), &v1::Jobs::Stub::ListJobs, request);
    const std::string next = page.next_page_token();
    page.clear_next_page_token();
    all.MergeFrom(page);
    if (next.empty() || next == request.page_token()) break;
    request.set_page_token(next);
  }
  session.json ? print_json(all) : fmt::print("{}", job_list_text({all.jobs().begin(), all.jobs().end()}));
  return ExitCode::done;
}

void print_job(const Session& session, const v1::Job& job) {
  session.json ? print_json(job) : fmt::print("{} {}\n", job.name(), v1::JobState_Name(job.state()));
}

// A command that names a job and answers how it stands then.
template <typename Request>
void add_state_command(CLI::App& app, Session& session, const char* command_name, const char* description,
                       grpc::Status (v1::Jobs::Stub::*method)(grpc::ClientContext*, const Request&, v1::Job*)) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, command_name, description, [&session, name, method] {
    Connection& connection = session.connection();
    Request request;
    request.set_name(job_name(*name));
    print_job(session, connection.call(connection.jobs(), method, request));
    return ExitCode::done;
  });
  command->add_option("NAME", *name, "A job's name")->required();
}

void add_delete_command(CLI::App& app, Session& session) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, "delete", "Delete a job and its results", [&session, name] {
    Connection& connection = session.connection();
    v1::DeleteJobRequest request;
    request.set_name(job_name(*name));
    const auto response = connection.call(connection.jobs(), &v1::Jobs::Stub::DeleteJob, request);
    session.json ? print_json(response) : fmt::print("{} deleted\n", request.name());
    return ExitCode::done;
  });
  command->add_option("NAME", *name, "A job's name")->required();
}

}  // namespace

void add_job_commands(CLI::App& app, Session& session) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* list = add_command(app, session, "list", "List the jobs, newest first",
                               [&session, options] { return run_list(session, *options); });
  list->add_option("--filter", options->filter, "Only jobs that match, such as 'state = RUNNING'");
  list->add_option("--order-by", options->order, "Another order, such as 'create_time'");
  add_state_command(app, session, "cancel", "Stop a job; what was computed is kept", &v1::Jobs::Stub::CancelJob);
  add_state_command(app, session, "suspend", "Stop a job at a checkpoint", &v1::Jobs::Stub::SuspendJob);
  add_state_command(app, session, "resume", "Continue a suspended job", &v1::Jobs::Stub::ResumeJob);
  add_delete_command(app, session);
}

}  // namespace cellcrush::client
