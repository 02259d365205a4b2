#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "commands/sweep_axis.h"
#include "commands/watch.h"
#include "connection/pages.h"
#include "terminal/json_text.h"
#include "terminal/sweep_table.h"
#include "terminal/sweep_text.h"

namespace cellcrush::client {

namespace {

struct SweepOptions {
  CaseOptions scene;
  std::vector<std::string> axes;
  std::vector<std::string> labels;
  std::string request_id;
  int priority = 0;
  double time_limit_s = 0.0;
  std::string executor;
  int max_parallel = 0;
  int max_failures = 0;
  bool watch = false;
};

v1::CreateSweepRequest build_request(const SweepOptions& options) {
  v1::CreateSweepRequest request;
  request.set_request_id(options.request_id);
  v1::Sweep& sweep = *request.mutable_sweep();
  *sweep.mutable_labels() = parse_labels(options.labels);
  sweep.set_priority(options.priority);
  sweep.set_time_limit_s(options.time_limit_s);
  sweep.set_executor(options.executor);
  sweep.set_max_parallel(options.max_parallel);
  sweep.set_max_failures(options.max_failures);
  for (const std::string& text : options.axes) {
    v1::SweepAxis axis = parse_axis(text);
    for (const v1::SweepAxis& other : sweep.axes()) {
      if (other.field() != axis.field()) continue;
      throw CommandError(ExitCode::refused,
                         "--over " + text + ": this field is given twice; give all its values in one --over");
    }
    sweep.add_axes()->Swap(&axis);
  }
  return request;
}

ExitCode run_sweep(Session& session, const SweepOptions& options) {
  v1::CreateSweepRequest request = build_request(options);
  Connection& connection = session.connection();
  *request.mutable_sweep()->mutable_case_() = read_case(options.scene.source, options.scene.assignments, connection);
  // From here on Ctrl-C ends the watch properly, even right after the sweep was queued.
  std::unique_ptr<Interruption> interruption;
  if (options.watch) interruption = std::make_unique<Interruption>();
  // The server answers only after checking all points.
  if (!session.json && isatty(STDERR_FILENO) != 0)
    fmt::print(stderr, "Checking {:.0f} points...\n", count_points(request.sweep()));
  const auto sweep = connection.call(connection.sweeps(), &v1::Sweeps::Stub::CreateSweep, request, kCheckPatience);
  if (session.json) {
    print_json(sweep);
  } else {
    fmt::print("{}\n", sweep.name());
    std::fflush(stdout);
  }
  fmt::print(stderr, "{}", session.json ? "" : notes_text(sweep.notes()));
  return options.watch ? watch_sweep(session, sweep.name(), *interruption) : ExitCode::done;
}

ExitCode run_retry(Session& session, const std::string& name) {
  Connection& connection = session.connection();
  v1::RetryFailedJobsRequest request;
  request.set_name(sweep_name(name));
  const auto sweep = connection.call(connection.sweeps(), &v1::Sweeps::Stub::RetryFailedJobs, request);
  session.json ? print_json(sweep) : fmt::print("{}", sweep_line(sweep));
  return ExitCode::done;
}

struct TableOptions {
  std::string name;
  bool csv = false;
  int digits = kTableDigits;
};

ExitCode run_table(Session& session, const TableOptions& options) {
  if (options.csv && session.json) throw CommandError(ExitCode::refused, "table: give either --csv or --json");
  Connection& connection = session.connection();
  const std::string name = sweep_name(options.name);
  const auto table = fetch_table(connection, name);
  if (session.json) {
    print_json(table);
  } else if (options.csv) {
    fmt::print("{}", sweep_table_csv(table));
  } else {
    const auto sweep = fetch_sweep(connection, name);
    fmt::print("{}", sweep_table_text(table, sweep.words().theory_note(), options.digits));
  }
  return ExitCode::done;
}

}  // namespace

void add_sweep_commands(CLI::App& app, Session& session) {
  const auto options = std::make_shared<SweepOptions>();
  CLI::App* sweep = add_command(app, session, "sweep", "Queue one job for each combination of field values",
                                [&session, options] { return run_sweep(session, *options); });
  sweep->group(kJobCommands);
  add_case_options(*sweep, options->scene);
  sweep
      ->add_option(
          "--over", options->axes,
          "Values of a field: PATH=V1,V2,...; PATH=FIRST:LAST:COUNT, evenly spaced; PATH=FIRST:LAST:COUNT:log, "
          "logarithmically spaced; PATH=seeds:N, 1 to N (may be repeated, for up to 32 fields; at most 100000 "
          "jobs in all)")
      ->required()
      ->group(kCaseOptions)
      ->allow_extra_args(false);
  sweep->add_flag("--watch", options->watch, "Follow the sweep to its end, then print its table and a chart")
      ->group(kOutputOptions);
  sweep
      ->add_option(
          "--request-id", options->request_id,
          "Id of the request, up to 128 characters; submitting it again returns the same sweep (default: none)")
      ->group(kIdentityOptions);
  add_label_option(*sweep, options->labels);
  add_priority_option(*sweep, options->priority);
  add_time_limit_option(*sweep, options->time_limit_s);
  add_executor_option(*sweep, options->executor);
  sweep
      ->add_option("--max-parallel", options->max_parallel,
                   "Maximum number of jobs of the sweep that run at once (default: as many as its executor runs)")
      ->group(kScheduleOptions)
      ->check(CLI::PositiveNumber);
  sweep
      ->add_option("--max-failures", options->max_failures,
                   "Stop starting jobs of the sweep after this many failures (default: no limit)")
      ->group(kScheduleOptions)
      ->check(CLI::PositiveNumber);
  add_examples(*sweep, {"cellcrush sweep preset:type-i --over loading.speed_m_per_s=50,100,200 --watch",
                        "cellcrush sweep my.txtpb --over lattice.imperfection.seed=seeds:20"});
  const auto name = std::make_shared<std::string>();
  CLI::App* retry = add_command(app, session, "retry", "Queue the failed jobs of a sweep again",
                                [&session, name] { return run_retry(session, *name); });
  retry->group(kJobCommands);
  retry->add_option("SWEEP", *name, "Name of a sweep")->required();
  add_examples(*retry, {"cellcrush retry sweeps/3"});
}

void add_table_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<TableOptions>();
  CLI::App* table = add_command(app, session, "table", "Print the results of a sweep, one row per job",
                                [&session, options] { return run_table(session, *options); });
  table->group(kResultCommands);
  table->add_option("SWEEP", options->name, "Name of a sweep")->required();
  table
      ->add_option("--digits", options->digits,
                   "Significant digits of the results; varied values are printed in full (default: 3)")
      ->group(kOutputOptions)
      ->check(CLI::Range(1, 17));
  table->add_flag("--csv", options->csv, "Print CSV with all digits")->group(kOutputOptions);
  add_examples(*table, {"cellcrush table sweeps/3", "cellcrush table sweeps/3 --csv > table.csv"});
}

}  // namespace cellcrush::client
