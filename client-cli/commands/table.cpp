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
};

ExitCode run_table(Session& session, const TableOptions& options) {
  if (options.csv && session.json) throw CommandError(ExitCode::refused, "table: give one of --csv and --json");
  const auto table = fetch_table(session.connection(), sweep_name(options.name));
  if (session.json) {
    print_json(table);
  } else {
    fmt::print("{}", options.csv ? sweep_table_csv(table) : sweep_table_text(table));
  }
  return ExitCode::done;
}

}  // namespace

void add_table_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<TableOptions>();
  CLI::App* table = add_command(app, session, "table", "Print a sweep's results, a line a job",
                                [&session, options] { return run_table(session, *options); });
  table->group(kResultCommands);
  table->add_option("SWEEP", options->name, "A sweep's name")->required();
  table->add_flag("--csv", options->csv, "As CSV, with all digits")->group(kOutputOptions);
  add_examples(*table, {"cellcrush table sweeps/3", "cellcrush table sweeps/3 --csv > table.csv"});
}

}  // namespace cellcrush::client
