#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>

#include "commands/commands.h"
#include "terminal/json_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

std::string hold_text(const v1::Queue::Hold& hold) {
  using google::protobuf::util::TimeUtil;
  const auto now = TimeUtil::GetCurrentTime();
  const auto seconds = [](const google::protobuf::Duration& duration) {
    return std::max(static_cast<double>(TimeUtil::DurationToMilliseconds(duration)) / 1e3, 0.0);
  };
  std::string text = fmt::format("the queue is held ({}) for {}: {} {}", hold.cause(),
                                 duration_text(seconds(now - hold.since())), hold.reason(), hold.remedy());
  if (hold.has_next_try_time())
    text += fmt::format(" The next try is in {}.", duration_text(seconds(hold.next_try_time() - now)));
  return text + "\n";
}

std::string queue_text(const v1::Queue& queue) {
  std::string held;
  for (const auto& hold : queue.holds()) held += hold_text(hold);
  if (queue.entries_size() == 0) return held + "the queue is empty\n";
  const bool priorities = std::any_of(queue.entries().begin(), queue.entries().end(),
                                      [](const v1::Queue::Entry& entry) { return entry.priority() != 0; });
  Table table({Table::Align::left, Table::Align::right, Table::Align::left, Table::Align::left});
  const auto add = [&](const std::string& job, const std::string& start, const std::string& priority,
                       const std::string& reason) {
    priorities ? table.add({job, start, priority, reason}) : table.add({job, start, reason});
  };
  add("JOB", "STARTS IN", "PRIORITY", "REASON");
  for (const auto& entry : queue.entries()) {
    add(entry.job(), entry.seconds_until_start() > 0 ? duration_text(entry.seconds_until_start()) : "",
        entry.priority() != 0 ? std::to_string(entry.priority()) : "", entry.reason());
  }
  std::string text = held + table.text();
  if (queue.more_count() > 0) text += fmt::format("and {} more\n", count_text(queue.more_count()));
  return text;
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
  session.json ? print_json(response)
               : fmt::print("the server takes no new jobs, leaves the running ones at a checkpoint and ends\n");
  return ExitCode::done;
}

}  // namespace

void add_queue_commands(CLI::App& app, Session& session) {
  add_command(app, session, "queue", "Say what waits, in the order in which it will start, and why",
              [&session] { return run_queue(session); });
  add_command(app, session, "drain", "Let the server leave its running jobs at a checkpoint and end",
              [&session] { return run_drain(session); });
}

}  // namespace cellcrush::client
