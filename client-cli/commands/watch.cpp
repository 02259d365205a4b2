#include "commands/watch.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

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
}

}  // namespace cellcrush::client
