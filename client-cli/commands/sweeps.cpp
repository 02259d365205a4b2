#include <fmt/format.h>

#include <charconv>
#include <set>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "terminal/json_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;

struct SweepOptions {
  CaseOptions scene;
  std::vector<std::string> axes;
};

std::string sweep_name(const std::string& name) {
  return name.find('/') == std::string::npos ? "sweeps/" + name : name;
}

// "PATH=V1,V2,..." as an axis.
v1::SweepAxis parse_axis(const std::string& text) {
  const auto refuse = [&](const std::string& message) {
    throw CommandError(ExitCode::refused, "--over " + text + ": " + message);
  };
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    refuse("expected PATH=V1,V2,..., such as loading.speed_m_per_s=50,100,200");
  v1::SweepAxis axis;
  axis.set_field(text.substr(0, equals));
  std::string_view rest = std::string_view(text).substr(equals + 1);
  while (true) {
    const std::string_view value = rest.substr(0, rest.find(','));
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size())
      refuse(fmt::format("\"{}\" is not a number", value));
    axis.mutable_list()->add_values(number);
    if (value.size() == rest.size()) return axis;
    rest.remove_prefix(value.size() + 1);
  }
}

std::string sweep_text(const v1::Sweep& sweep) {
  std::string text = fmt::format("{}: {} jobs", sweep.name(), sweep.jobs_size());
  for (const auto& [state, count] :
       std::map<std::string, int>(sweep.state_counts().begin(), sweep.state_counts().end())) {
    text += fmt::format(", {} {}", count, state);
  }
  return printable(text) + '\n';
}

// A line when a job of the sweep changes its state.
void print_sweep_event(const v1::WatchSweepResponse& response) {
  const v1::JobEvent& event = response.event();
  if (response.has_snapshot()) fmt::print("{}", sweep_text(response.snapshot()));
  const v1::Job* job = event.has_state() ? &event.state() : event.has_snapshot() ? &event.snapshot().job() : nullptr;
  if (job != nullptr) fmt::print("{} {}\n", printable(job->name()), v1::JobState_Name(job->state()));
  std::fflush(stdout);
}

ExitCode watch_sweep(Session& session, const std::string& name) {
  grpc::ClientContext context;
  v1::WatchSweepRequest request;
  request.set_name(name);
  const auto reader = session.connection().sweeps().WatchSweep(&context, request);
  v1::WatchSweepResponse response;
  std::set<std::string> failed;
  while (reader->Read(&response)) {
    session.json ? print_json(response) : print_sweep_event(response);
    const v1::JobState state = response.event().state().state();
    if (state == v1::FAILED || state == v1::CANCELLED) failed.insert(response.job());
  }
  const grpc::Status status = reader->Finish();
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE) {
    throw CommandError(ExitCode::cut_off, "the watch of " + name + " was cut off: " + status.error_message());
  }
  if (!status.ok()) throw error_of(status);
  return failed.empty() ? ExitCode::done : ExitCode::job_failed;
}

ExitCode run_sweep(Session& session, const SweepOptions& options, bool watch) {
  Connection& connection = session.connection();
  v1::CreateSweepRequest request;
  for (const std::string& axis : options.axes) *request.mutable_sweep()->add_axes() = parse_axis(axis);
  *request.mutable_sweep()->mutable_case_() = read_case(options.scene.source, options.scene.assignments, connection);
  const auto sweep = connection.call(connection.sweeps(), &v1::Sweeps::Stub::CreateSweep, request);
  session.json ? print_json(sweep) : fmt::print("{}\n", sweep.name());
  std::fflush(stdout);
  return watch ? watch_sweep(session, sweep.name()) : ExitCode::done;
}

std::string table_text(const v1::SweepTable& results) {
  std::vector<Align> columns = {Align::left, Align::left};
  std::vector<std::string> heading = {"JOB", "STATE"};
  for (const std::string& field : results.fields()) {
    columns.push_back(Align::right);
    heading.push_back(field);
  }
  for (const char* name : {"impact (MPa)", "support (MPa)", "shock theory (MPa)", "Gibson-Ashby (MPa)"}) {
    columns.push_back(Align::right);
    heading.emplace_back(name);
  }
  Table table(columns);
  table.add(heading);
  for (const auto& row : results.rows()) {
    const v1::Summary& summary = row.result().summary();
    std::vector<std::string> cells = {row.job(), v1::JobState_Name(row.result().state())};
    for (const double value : row.values()) cells.push_back(number_text(value, 4));
    cells.resize(static_cast<std::size_t>(results.fields_size()) + 2);
    cells.push_back(summary.has_plateau_stress_impact_mpa() ? number_text(summary.plateau_stress_impact_mpa()) : "");
    cells.push_back(summary.has_plateau_stress_support_mpa() ? number_text(summary.plateau_stress_support_mpa()) : "");
    cells.push_back(summary.has_theory() ? number_text(summary.theory().shock_mpa()) : "");
    cells.push_back(summary.has_theory() ? number_text(summary.theory().gibson_ashby_mpa()) : "");
    table.add(std::move(cells));
  }
  return table.text();
}

template <typename Request, typename Response>
void add_named_command(CLI::App& app, Session& session, const char* command_name, const char* description,
                       grpc::Status (v1::Sweeps::Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                       std::string (*text)(const Response&)) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, command_name, description, [&session, name, method, text] {
    Connection& connection = session.connection();
    Request request;
    request.set_name(sweep_name(*name));
    const Response response = connection.call(connection.sweeps(), method, request);
    session.json ? print_json(response) : fmt::print("{}", text(response));
    return ExitCode::done;
  });
  command->add_option("SWEEP", *name, "A sweep's name")->required();
}

}  // namespace

void add_sweep_commands(CLI::App& app, Session& session) {
  const auto options = std::make_shared<SweepOptions>();
  const auto watch = std::make_shared<bool>(false);
  CLI::App* sweep = add_command(app, session, "sweep", "Queue a job for every combination of some fields' values",
                                [&session, options, watch] { return run_sweep(session, *options, *watch); });
  add_case_options(*sweep, options->scene);
  sweep->add_option("--over", options->axes, "PATH=V1,V2,...: the values that a field takes")
      ->required()
      ->allow_extra_args(false);
  sweep->add_flag("--watch", *watch, "Follow its jobs to their ends");
  add_named_command(app, session, "retry", "Queue a sweep's failed jobs again", &v1::Sweeps::Stub::RetryFailedJobs,
                    &sweep_text);
  add_named_command(app, session, "table", "Print a sweep's results, a line a job", &v1::Sweeps::Stub::GetSweepTable,
                    &table_text);
}

}  // namespace cellcrush::client
