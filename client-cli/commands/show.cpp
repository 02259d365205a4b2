#include <fmt/format.h>

#include <algorithm>

#include "case_file/case_source.h"
#include "columns/sweep_csv.h"
#include "commands/commands.h"
#include "connection/connection.h"
#include "results/sweep_results.h"
#include "terminal/case_text.h"
#include "terminal/job_list_text.h"
#include "terminal/job_text.h"
#include "terminal/sweep_table.h"
#include "terminal/sweep_text.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

void show_preset(Session& session, const std::string& name) {
  Connection& connection = session.connection();
  const auto preset = connection.call_for(name, connection.cases(), &v1::Cases::Stub::GetPreset);
  session.json ? print_json(preset) : fmt::print("{}", case_file_text(preset.case_(), preset_heading(preset)));
}

void show_job(Session& session, const std::string& name) {
  const std::string found = session.find_job(name);
  auto job = fetch_job(session.connection(), found);
  if (names_file(name)) job.set_name(name);
  session.json ? print_json(job) : fmt::print("{}", description_text(job));
}

void show_sweep(Session& session, const std::string& name) {
  const auto sweep = fetch_sweep(session.connection(), name);
  session.json ? print_json(sweep) : fmt::print("{}", description_text(sweep));
}

constexpr int kListPage = 1000;

struct ListOptions {
  std::string filter;
  std::string order;
  int limit = 0;  ///< 0: all
  bool sweeps = false;
};

// Sets the size of the next page, given the `size` entries received; false if that is enough.
template <typename Request>
bool ask_for_more(const ListOptions& options, int size, Request& request) {
  request.set_page_size(options.limit > 0 ? std::min(kListPage, options.limit - size) : kListPage);
  return options.limit == 0 || size < options.limit;
}

void list_jobs(Session& session, const ListOptions& options) {
  Connection& connection = session.connection();
  v1::ListJobsRequest request;
  request.set_filter(options.filter);
  request.set_order_by(options.order);
  const auto all = call_for_pages(connection, connection.jobs(), &v1::Jobs::Stub::ListJobs, request,
                                  [&](const v1::ListJobsResponse& so_far, v1::ListJobsRequest& next) {
                                    return ask_for_more(options, so_far.jobs_size(), next);
                                  });
  session.json ? print_json(all) : fmt::print("{}", job_list_text({all.jobs().begin(), all.jobs().end()}));
}

void list_sweeps(Session& session, const ListOptions& options) {
  if (!options.filter.empty() || !options.order.empty()) {
    refuse("list: --filter and --order apply to jobs only; leave them out with --sweeps");
  }
  Connection& connection = session.connection();
  const auto all =
      call_for_pages(connection, connection.sweeps(), &v1::Sweeps::Stub::ListSweeps, v1::ListSweepsRequest(),
                     [&](const v1::ListSweepsResponse& so_far, v1::ListSweepsRequest& next) {
                       return ask_for_more(options, so_far.sweeps_size(), next);
                     });
  session.json ? print_json(all) : fmt::print("{}", sweep_list_text({all.sweeps().begin(), all.sweeps().end()}));
}

struct TableOptions {
  std::vector<std::string> names;
  bool csv = false;
  bool each = false;
  bool decimal_comma = false;
  int digits = kTableDigits;
};

ExitCode run_table(Session& session, const TableOptions& options) {
  if (options.csv && session.json) refuse("table: give either --csv or --json");
  if (options.decimal_comma && !options.csv) refuse("table: --decimal-comma applies to CSV only; add --csv");
  const bool of_files = std::ranges::any_of(options.names, names_file);
  if (!of_files && options.names.size() > 1) refuse("table: name one sweep, or any number of results");
  const std::string name = of_files ? "" : sweep_name(options.names.front());
  const auto [table, of_cases] =
      of_files ? tabulate_results(session, options.names) : ResultTable{fetch_table(session.connection(), name), {}};
  if (session.json) {
    print_json(table);
  } else if (options.csv) {
    fmt::print("{}", sweep_table_csv(shown_table(table, options.each), decimal_of(options.decimal_comma)));
  } else {
    const std::string note = of_files ? of_cases : fetch_sweep(session.connection(), name).words().theory_note();
    fmt::print("{}", sweep_table_text(shown_table(table, options.each), note, options.digits));
  }
  return ExitCode::done;
}

}  // namespace

void add_show_commands(CLI::App& app, Session& session) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      add_command(app, session, kCaseCommands, "show",
                  "Print a preset as a complete case file, or describe a job or a sweep", [&session, name] {
                    if (const std::string preset = preset_name(*name); !preset.empty()) {
                      show_preset(session, preset);
                    } else {
                      names_sweep(*name) ? show_sweep(session, *name) : show_job(session, *name);
                    }
                    return ExitCode::done;
                  });
  command->add_option("NAME", *name, "preset:NAME, name of a job or a sweep, or a result.h5 file or its folder")
      ->required();
  add_examples(*command, {"cellcrush show preset:type-i > my.txtpb", "cellcrush show jobs/12"});
  const auto list_options = std::make_shared<ListOptions>();
  CLI::App* list =
      add_command(app, session, kJobCommands, "list", "List jobs or sweeps, newest first", [&session, list_options] {
        list_options->sweeps ? list_sweeps(session, *list_options) : list_jobs(session, *list_options);
        return ExitCode::done;
      });
  add_option(*list, kSelectionOptions, "--filter", list_options->filter,
             "Only jobs that match: state = STATE, owner = \"NAME\", label.KEY = \"value\" or title : \"text\", "
             "joined by AND; up to 4096 characters (default: all jobs)");
  add_option(*list, kSelectionOptions, "--order,--order-by", list_options->order,
             "Sort jobs by create_time or name; append desc to reverse the order (default: create_time desc)");
  add_option(*list, kSelectionOptions, "--limit", list_options->limit, "Maximum number of entries (default: all)")
      ->check(CLI::PositiveNumber);
  add_option(*list, kSelectionOptions, "--sweeps", list_options->sweeps, "List sweeps instead of jobs");
  add_examples(*list, {"cellcrush list --limit 10", "cellcrush list --filter 'state = RUNNING'",
                       "cellcrush list --sweeps --json"});
  const auto [table, table_options] = add_command<TableOptions>(
      app, session, kResultCommands, "table",
      "Print the results of a sweep, as means over its seeds if it varies them, or of files", run_table);
  table
      ->add_option("NAME", table_options->names,
                   "Name of a sweep, or results of `run` or `fetch` (result.h5 files or their folders)")
      ->required();
  add_option(
      *table, kOutputOptions, "--digits", table_options->digits,
      "Significant digits of the results; varied values have up to 6, but integers are printed in full (default: 3)")
      ->check(CLI::Range(1, 17));
  add_option(*table, kOutputOptions, "--each", table_options->each, "One row per job instead of means over the seeds");
  add_option(*table, kOutputOptions, "--csv", table_options->csv,
             "Print CSV with all digits; means with the half-widths of their 95 % intervals and numbers of jobs");
  add_option(*table, kOutputOptions, "--decimal-comma", table_options->decimal_comma, kDecimalCommaHelp);
  add_examples(*table, {"cellcrush table sweeps/3", "cellcrush table sweeps/3 --each --csv > table.csv",
                        "cellcrush table thin/result.h5 thick/result.h5"});
}

}  // namespace cellcrush::client
