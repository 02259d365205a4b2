#include <fmt/format.h>

#include "commands/commands.h"
#include "commands/resource_name.h"
#include "connection/pages.h"
#include "terminal/json_text.h"
#include "terminal/sweep_table.h"

namespace cellcrush::client {

namespace {

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
    fmt::print("{}", sweep_table_text(table, sweep.case_().lattice(), options.digits));
  }
  return ExitCode::done;
}

}  // namespace

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
