#include "commands/watch.h"

#include <fmt/format.h>

#include <cstdio>

#include "terminal/job_text.h"
#include "terminal/watch_display.h"

namespace cellcrush::client {

ExitCode watch_job(Session& session, const std::string& name, const Interruption& interruption) {
  const auto display = make_watch_display(session.json, find_terminal());
  if (!follow_job(session.connection(), name, false, interruption, *display)) {
    const v1::Job& job = display->view().job();
    const bool ended = is_final(job.state());
    fmt::print(stderr, "\ncellcrush: the watch ends here; {} {}: `cellcrush watch {}` picks it up again\n", name,
               ended ? "has ended" : "goes on", name);
    return ExitCode::interrupted;
  }
  display->finish();
  const v1::Job& job = display->view().job();
  if (!session.json) fmt::print("{}", outcome_text(job));
  return exit_code_of(job.state());
}

void add_watch_command(CLI::App& app, Session& session) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, "watch", "Follow a job to its end", [&session, name] {
    const Interruption interruption;
    return watch_job(session, job_name(*name), interruption);
  });
  command->add_option("NAME", *name, "A job's name")->required();
}

}  // namespace cellcrush::client
