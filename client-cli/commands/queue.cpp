#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "commands/commands.h"
#include "connection/interruption.h"
#include "terminal/json_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

constexpr std::chrono::seconds kToAnswer{5};
constexpr std::chrono::milliseconds kBetweenLooks{200};

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
  return text;
}

std::string queue_text(const v1::Queue& queue, int width) {
  std::string held;
  for (const auto& hold : queue.holds()) held += wrapped(hold_text(hold), width);
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
  std::string text = held + table.text(0, width);
  if (queue.more_count() > 0) text += fmt::format("and {} more\n", count_text(queue.more_count()));
  return text;
}

ExitCode run_queue(Session& session) {
  Connection& connection = session.connection();
  const auto queue = connection.call(connection.admin(), &v1::Admin::Stub::GetQueue, v1::GetQueueRequest());
  session.json ? print_json(queue) : fmt::print("{}", queue_text(queue, terminal_width()));
  return ExitCode::done;
}

// Whether the server that was drained has ended: nobody answers, or one that was not drained.
bool has_ended(Connection& connection) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kToAnswer);
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
      fmt::print(stderr, "cellcrush: not waiting any longer; the server ends by itself\n");
      return ExitCode::interrupted;
    }
  }
  if (session.json) {
    print_json(response);
  } else {
    fmt::print("{}\n", wait ? "the server has ended; its running jobs are at a checkpoint"
                            : "the server takes no new jobs, leaves the running ones at a checkpoint and ends");
  }
  return ExitCode::done;
}

}  // namespace

void add_queue_commands(CLI::App& app, Session& session) {
  CLI::App* queue = add_command(app, session, "queue", "List the waiting jobs in the order of their start, and why",
                                [&session] { return run_queue(session); });
  queue->group(kServerCommands);
  add_examples(*queue, {"cellcrush queue"});
  const auto wait = std::make_shared<bool>(false);
  CLI::App* drain = add_command(app, session, "drain", "Let the server leave its running jobs at a checkpoint and end",
                                [&session, wait] { return run_drain(session, *wait); });
  drain->group(kServerCommands);
  drain->add_flag("--wait", *wait,
                  "Return once the server has ended: 0 then, 130 after Ctrl-C, which does not stop it");
  add_examples(*drain, {"cellcrush drain --wait"});
}

}  // namespace cellcrush::client
