#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <set>
#include <utility>

#include "commands/commands.h"
#include "connection/streams.h"
#include "terminal/job_list_text.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

constexpr std::chrono::seconds kToAnswer{5};
constexpr std::chrono::milliseconds kBetweenLooks{200};

// The jobs of the queue's entries: the server lists waiting jobs, oldest first.
std::vector<v1::Job> fetch_waiting(Connection& connection, const v1::Queue& queue) {
  std::set<std::string> missing;
  for (const auto& entry : queue.entries()) missing.insert(entry.job());
  std::vector<v1::Job> found;
  v1::ListJobsRequest request;
  request.set_filter("state = PENDING");
  request.set_order_by("create_time");
  request.set_page_size(1000);
  while (!missing.empty()) {
    auto page = connection.call(connection.jobs(), &v1::Jobs::Stub::ListJobs, request);
    for (v1::Job& job : *page.mutable_jobs()) {
      if (missing.erase(job.name()) > 0) found.push_back(std::move(job));
    }
    if (page.next_page_token().empty() || page.next_page_token() == request.page_token()) break;
    request.set_page_token(page.next_page_token());
  }
  return found;
}

ExitCode run_queue(Session& session) {
  Connection& connection = session.connection();
  const auto queue = connection.call(connection.admin(), &v1::Admin::Stub::GetQueue, v1::GetQueueRequest());
  session.json ? print_json(queue) : fmt::print("{}", queue_text(queue, fetch_waiting(connection, queue)));
  return ExitCode::done;
}

ExitCode run_status(Session& session) {
  Connection& connection = session.connection();
  const auto server =
      connection.call(connection.admin(), &v1::Admin::Stub::GetCapabilities, v1::GetCapabilitiesRequest());
  const auto queue = connection.call(connection.admin(), &v1::Admin::Stub::GetQueue, v1::GetQueueRequest());
  if (session.json) {
    print_json(server);
    print_json(queue);
  } else {
    fmt::print("{}", status_text(server, queue));
  }
  return ExitCode::done;
}

// Whether the drained server has ended: nobody answers, or a server that was not drained.
bool has_ended(Connection& connection) {
  grpc::ClientContext context;
  connection.prepare(context, kToAnswer);
  v1::Capabilities capabilities;
  const auto status = connection.admin().GetCapabilities(&context, v1::GetCapabilitiesRequest(), &capabilities);
  if (status.ok()) return !capabilities.draining();
  const ExitCode code = exit_code_of(status.error_code());
  if (code != ExitCode::no_connection && code != ExitCode::cut_off) throw error_of(status);
  return code == ExitCode::no_connection;
}

ExitCode run_drain(Session& session, bool wait) {
  Connection& connection = session.connection();
  const auto response = connection.call(connection.admin(), &v1::Admin::Stub::Drain, v1::DrainRequest());
  if (wait) {
    const Interruption interruption;
    while (!has_ended(connection)) {
      if (!interruption.wait_for(kBetweenLooks)) continue;
      fmt::print(stderr, "cellcrush: stopped waiting; the server still shuts down\n");
      return ExitCode::interrupted;
    }
  }
  if (session.json) {
    print_json(response);
  } else {
    fmt::print("{}\n", wait ? "the server has exited; its running jobs are checkpointed"
                            : "the server accepts no new jobs, checkpoints the running ones and exits");
  }
  return ExitCode::done;
}

}  // namespace

void add_queue_commands(CLI::App& app, Session& session) {
  CLI::App* queue =
      add_command(app, session, kServerCommands, "queue", "List the waiting jobs in starting order, and why they wait",
                  [&session] { return run_queue(session); });
  add_examples(*queue, {"cellcrush queue"});
  CLI::App* status =
      add_command(app, session, kServerCommands, "status",
                  "Print the version of the server, how long it runs, its jobs, its disk, and what holds its queue",
                  [&session] { return run_status(session); });
  add_examples(*status, {"cellcrush status", "cellcrush status --json"});
  const auto wait = std::make_shared<bool>(false);
  CLI::App* drain =
      add_command(app, session, kServerCommands, "drain", "Shut the server down; it checkpoints its running jobs",
                  [&session, wait] { return run_drain(session, *wait); });
  drain->add_flag("--wait", *wait, "Wait until the server has exited; Ctrl-C ends the wait, not the shutdown");
  add_examples(*drain, {"cellcrush drain --wait"});
}

}  // namespace cellcrush::client
