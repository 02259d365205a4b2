#include <fmt/format.h>

#include "commands/commands.h"
#include "terminal/json_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

std::string queue_text(const v1::Queue& queue) {
  if (queue.entries_size() == 0) return "the queue is empty\n";
  Table table({Table::Align::left, Table::Align::right, Table::Align::left});
  table.add({"JOB", "STARTS IN", "REASON"});
  for (const auto& entry : queue.entries()) {
    table.add({entry.job(), entry.seconds_until_start() > 0 ? duration_text(entry.seconds_until_start()) : "",
               entry.reason()});
  }
  return table.text();
}

ExitCode run_queue(Session& session) {
  Connection& connection = session.connection();
  const auto queue = connection.call(connection.admin(), &v1::Admin::Stub::GetQueue, v1::GetQueueRequest());
  session.json ? print_json(queue) : fmt::print("{}", queue_text(queue));
  return ExitCode::done;
}

ExitCode run_drain(Session& session) {
  Connection& connection = session.connection();
  const auto response = connection.call(connection.admin(), &v1::Admin::Stub::Drain, v1::DrainRequest());
  session.json ? print_json(response) : fmt::print("the server takes no new jobs and ends after the running ones\n");
  return ExitCode::done;
}

}  // namespace

void add_queue_commands(CLI::App& app, Session& session) {
  add_command(app, session, "queue", "Say what waits, what runs, and why", [&session] { return run_queue(session); });
  add_command(app, session, "drain", "Let the server end after its running jobs",
              [&session] { return run_drain(session); });
}

}  // namespace cellcrush::client
