#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "commands/creation.h"
#include "commands/sweep_axis.h"
#include "commands/watch.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

// What submit and sweep have in common.
struct SubmitOptions {
  CaseOptions scene;
  bool watch = false;
  std::string request_id;
  std::vector<std::string> labels;
  std::string note;
  int priority = 0;
  double time_limit_s = 0.0;
  std::string executor;
};

struct SweepOptions : SubmitOptions {
  std::vector<std::string> axes;
  int max_parallel = 0;
  int max_failures = 0;
};

void add_submit_options(CLI::App& command, SubmitOptions& options, const std::string& what, const char* watching) {
  add_case_options(command, options.scene);
  add_option(command, kOutputOptions, "--watch", options.watch, watching);
  add_option(command, kIdentityOptions, "--request-id", options.request_id,
             "Id of the request, up to 128 characters; submitting it again returns the same " + what +
                 " (default: a new one)");
  add_option(command, kIdentityOptions, "--label", options.labels,
             "Label KEY=VALUE for list --filter; KEY up to 63 and VALUE up to 255 characters (may be repeated up "
             "to 64 times; default: none)")
      ->allow_extra_args(false);
  add_option(command, kIdentityOptions, "--note", options.note,
             "Note on the " + what + ", up to 2000 bytes; `cellcrush note` changes it (default: none)");
  add_option(command, kScheduleOptions, "--priority", options.priority,
             "Waiting jobs of higher priority start first; -100 to 100 (default: 0)")
      ->check(CLI::Range(-100, 100));
  add_time_limit_option(command, options.time_limit_s);
  add_executor_option(command, options.executor);
}

// Fills what a job's request and a sweep have in common.
template <typename Target>
void fill(const SubmitOptions& options, Target& target) {
  for (const std::string& text : options.labels) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) {
      refuse("--label " + text + ": expected KEY=VALUE");
    }
    (*target.mutable_labels())[text.substr(0, equals)] = text.substr(equals + 1);
  }
  target.set_note(options.note);
  target.set_priority(options.priority);
  target.set_time_limit_s(options.time_limit_s);
  target.set_executor(options.executor);
}

v1::CreateSweepRequest build_request(const SweepOptions& options) {
  v1::CreateSweepRequest request;
  v1::Sweep& sweep = *request.mutable_sweep();
  fill(options, sweep);
  sweep.set_max_parallel(options.max_parallel);
  sweep.set_max_failures(options.max_failures);
  for (const std::string& text : options.axes) {
    v1::SweepAxis axis = parse_axis(text);
    for (const v1::SweepAxis& other : sweep.axes()) {
      if (other.field() != axis.field()) continue;
      refuse("--over " + text + ": this field is given twice; give all its values in one --over");
    }
    sweep.add_axes()->Swap(&axis);
  }
  return request;
}

// Prints the name of what was created, and watches it if asked to.
template <typename Created>
ExitCode finish(Session& session, const Created& created, const Interruption* watch,
                ExitCode (*follow)(Session&, const std::string&, const Interruption&)) {
  if (session.json) {
    print_json(created);
  } else {
    fmt::print("{}\n", created.name());
    std::fflush(stdout);
    fmt::print(stderr, "{}", notes_text(created.notes()));
  }
  return watch != nullptr ? follow(session, created.name(), *watch) : ExitCode::done;
}

ExitCode run_submit(Session& session, const SubmitOptions& options) {
  v1::CreateJobRequest request;
  request.set_request_id(options.request_id);
  fill(options, request);
  Connection& connection = session.connection();
  *request.mutable_case_() = read_case(options.scene, connection);
  // From here on Ctrl-C ends the watch properly, even right after the job was queued.
  const auto interruption = options.watch ? std::make_unique<Interruption>() : nullptr;
  const auto job = create(session, connection.jobs(), &v1::Jobs::Stub::CreateJob, request);
  return finish(session, job, interruption.get(), watch_job);
}

ExitCode run_sweep(Session& session, const SweepOptions& options) {
  v1::CreateSweepRequest request = build_request(options);
  request.set_request_id(options.request_id);
  Connection& connection = session.connection();
  *request.mutable_sweep()->mutable_case_() = read_case(options.scene, connection);
  const auto interruption = options.watch ? std::make_unique<Interruption>() : nullptr;
  // The server answers only after checking all points.
  if (!session.json && isatty(STDERR_FILENO) != 0) {
    for (const v1::SweepAxis& axis : request.sweep().axes()) fmt::print(stderr, "{}\n", axis_text(axis));
    fmt::print(stderr, "Checking {:.0f} points...\n", count_points(request.sweep()));
  }
  const auto sweep = create(session, connection.sweeps(), &v1::Sweeps::Stub::CreateSweep, request, kCheckPatience);
  return finish(session, sweep, interruption.get(), watch_sweep);
}

}  // namespace

void add_submit_commands(CLI::App& app, Session& session) {
  const auto [submit, options] = add_command<SubmitOptions>(app, session, kJobCommands, "submit",
                                                            "Queue a case and print the job name", run_submit);
  add_submit_options(*submit, *options, "job", "Follow the job to its end");
  add_examples(*submit, {"cellcrush submit my.txtpb --watch",
                         "cellcrush submit preset:type-i --set loading.speed_m_per_s=50 --time-limit 2h"});
  const auto [sweep, grid] = add_command<SweepOptions>(app, session, kJobCommands, "sweep",
                                                       "Queue one job for each combination of field values", run_sweep);
  add_submit_options(*sweep, *grid, "sweep", "Follow the sweep to its end, then print its table and a chart");
  add_option(
      *sweep, kCaseOptions, "--over", grid->axes,
      "Values of a field: PATH=V1,V2,...; PATH=FIRST:LAST:COUNT, evenly spaced; PATH=FIRST:LAST:COUNT:log, "
      "logarithmically spaced; lattice.imperfection.seed=seeds:N, 1 to N (may be repeated, for up to 32 fields; at "
      "most 100000 jobs in all)")
      ->required()
      ->allow_extra_args(false);
  add_option(*sweep, kScheduleOptions, "--max-parallel", grid->max_parallel,
             "Maximum number of jobs of the sweep that run at once (default: as many as its executor runs)")
      ->check(CLI::PositiveNumber);
  add_option(*sweep, kScheduleOptions, "--max-failures", grid->max_failures,
             "Stop starting jobs of the sweep after this many failures (default: no limit)")
      ->check(CLI::PositiveNumber);
  add_examples(*sweep, {"cellcrush sweep preset:type-i --over loading.speed_m_per_s=50,100,200 --watch",
                        "cellcrush sweep my.txtpb --over lattice.imperfection.seed=seeds:20"});
}

}  // namespace cellcrush::client
