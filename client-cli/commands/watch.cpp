#include "commands/watch.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.h"
#include "connection/connection.h"
#include "results/sweep_results.h"
#include "terminal/job_text.h"
#include "terminal/sweep_chart_text.h"
#include "terminal/sweep_table.h"
#include "terminal/terminal.h"
#include "terminal/watch_display.h"

namespace cellcrush::client {

namespace {

ExitCode say_interrupted(const std::string& name, bool ended) {
  fmt::print(stderr, "\ncellcrush: stopped watching; {} {}: `cellcrush watch {}` shows it again\n", name,
             ended ? "has ended" : "continues", name);
  return ExitCode::interrupted;
}

}  // namespace

WatchedJob show_job_to_its_end(Session& session, const std::string& name, const Interruption& interruption,
                               const std::string& time_limit_remedy) {
  const auto display = make_job_display(session.json, find_terminal());
  const bool complete = follow_job(session.connection(), name, interruption, *display);
  v1::Job job = display->view().job();
  if (job.cause() == v1::Job::TIME_LIMIT && !time_limit_remedy.empty()) job.set_remedy(time_limit_remedy);
  if (complete) {
    display->finish();
    if (!session.json) fmt::print("{}", outcome_text(job));
  }
  return {std::move(job), complete};
}

ExitCode watch_job(Session& session, const std::string& name, const Interruption& interruption) {
  const auto [job, complete] = show_job_to_its_end(session, name, interruption);
  return complete ? exit_code_of(job.state()) : say_interrupted(name, is_final(job.state()));
}

WatchedSweep show_sweep_to_its_end(Session& session, const std::string& name, const Interruption& interruption) {
  const auto display = make_sweep_display(session.json, find_terminal());
  const bool complete = follow_sweep(session.connection(), name, interruption, *display);
  const SweepView& view = display->view();
  const int jobs = static_cast<int>(view.jobs().size());
  if (complete) {
    display->finish();
  } else {
    say_interrupted(name, jobs > 0 && view.count_ended() == jobs);
  }
  return {view.sweep(), complete, complete && view.count(v1::Job::SUCCEEDED) == jobs};
}

ExitCode watch_sweep(Session& session, const std::string& name, const Interruption& interruption) {
  const WatchedSweep watched = show_sweep_to_its_end(session, name, interruption);
  if (!watched.complete) return ExitCode::interrupted;
  const auto table = fetch_table(session.connection(), name);
  session.json ? print_json(table)
               : fmt::print("\n{}{}", sweep_table_text(shown_table(table, false), watched.sweep.words().theory_note()),
                            sweep_chart_text(charted_table(table, false), find_terminal().unicode, terminal_width()));
  return watched.all_succeeded ? ExitCode::done : ExitCode::job_failed;
}

namespace {

// Keeps the newest state and shows nothing.
template <typename Event, typename View>
class Silent : public Watcher<Event> {
 public:
  void on_event(const Event& event) override { view.apply(event); }
  void on_break(const std::string&) override {}

  View view;
};

// Waits for the end and prints the outcome in a line.
ExitCode wait_for_job(Session& session, const std::string& name, const Interruption& interruption) {
  Silent<v1::JobEvent, JobView> watcher;
  if (!follow_job(session.connection(), name, interruption, watcher)) return ExitCode::interrupted;
  const v1::Job& job = watcher.view.job();
  session.json ? print_json(job) : fmt::print("{} {}\n", name, v1::Job::State_Name(job.state()));
  return exit_code_of(job.state());
}

ExitCode wait_for_sweep(Session& session, const std::string& name, const Interruption& interruption) {
  Silent<v1::WatchSweepResponse, SweepView> watcher;
  if (!follow_sweep(session.connection(), name, interruption, watcher)) return ExitCode::interrupted;
  const int all = static_cast<int>(watcher.view.jobs().size());
  const int succeeded = watcher.view.count(v1::Job::SUCCEEDED);
  session.json ? print_json(watcher.view.sweep()) : fmt::print("{} SUCCEEDED {} of {}\n", name, succeeded, all);
  return succeeded == all ? ExitCode::done : ExitCode::job_failed;
}

ExitCode wait_for_all(Session& session, const std::vector<std::string>& names) {
  // A name that is none is told at once.
  Connection& connection = session.connection();
  for (const std::string& name : names) {
    if (names_sweep(name)) {
      v1::GetSweepRequest request;
      request.set_name(name);
      connection.call(connection.sweeps(), &v1::Sweeps::Stub::GetSweep, request);
    } else {
      fetch_job(connection, job_name(name));
    }
  }
  const Interruption interruption;
  ExitCode worst = ExitCode::done;
  for (const std::string& name : names) {
    const ExitCode code = names_sweep(name) ? wait_for_sweep(session, name, interruption)
                                            : wait_for_job(session, job_name(name), interruption);
    if (code == ExitCode::interrupted) return code;
    std::fflush(stdout);
    if (code != ExitCode::done) worst = code;
  }
  return worst;
}

}  // namespace

void add_watch_command(CLI::App& app, Session& session) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      add_command(app, session, kJobCommands, "watch", "Follow a job or a sweep to its end", [&session, name] {
        const Interruption interruption;
        return names_sweep(*name) ? watch_sweep(session, *name, interruption)
                                  : watch_job(session, job_name(*name), interruption);
      });
  command->add_option("NAME", *name, "Name of a job or a sweep")->required();
  add_examples(*command, {"cellcrush watch jobs/12", "cellcrush watch sweeps/3"});
  const auto names = std::make_shared<std::vector<std::string>>();
  CLI::App* wait = add_command(app, session, kJobCommands, "wait",
                               "Wait for the end of jobs and sweeps, and print a line for each; for scripts",
                               [&session, names] { return wait_for_all(session, *names); });
  wait->add_option("NAME", *names, "Names of jobs and sweeps")->required();
  add_examples(*wait, {"cellcrush wait jobs/12 jobs/13", "cellcrush wait sweeps/3"});
}

}  // namespace cellcrush::client
