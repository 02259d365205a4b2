#include <fmt/format.h>

#include <algorithm>

#include "commands/commands.h"
#include "connection/pages.h"
#include "terminal/job_list_text.h"
#include "terminal/json_text.h"
#include "terminal/sweep_text.h"

namespace cellcrush::client {

namespace {

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
    throw CommandError(ExitCode::refused,
                       "list: --filter and --order apply to jobs only; leave them out with --sweeps");
  }
  Connection& connection = session.connection();
  const auto all =
      call_for_pages(connection, connection.sweeps(), &v1::Sweeps::Stub::ListSweeps, v1::ListSweepsRequest(),
                     [&](const v1::ListSweepsResponse& so_far, v1::ListSweepsRequest& next) {
                       return ask_for_more(options, so_far.sweeps_size(), next);
                     });
  session.json ? print_json(all) : fmt::print("{}", sweep_list_text({all.sweeps().begin(), all.sweeps().end()}));
}

}  // namespace

void add_list_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* list = add_command(app, session, "list", "List jobs or sweeps, newest first", [&session, options] {
    options->sweeps ? list_sweeps(session, *options) : list_jobs(session, *options);
    return ExitCode::done;
  });
  list->group(kJobCommands);
  list->add_option("--filter", options->filter,
                   "Only jobs that match: state = STATE, owner = \"NAME\", label.KEY = \"value\" or title : \"text\", "
                   "joined by AND; up to 4096 characters (default: all jobs)")
      ->group(kSelectionOptions);
  list->add_option("--order,--order-by", options->order,
                   "Sort jobs by create_time or name; append desc to reverse the order (default: create_time desc)")
      ->group(kSelectionOptions);
  list->add_option("--limit", options->limit, "Maximum number of entries (default: all)")
      ->group(kSelectionOptions)
      ->check(CLI::PositiveNumber);
  list->add_flag("--sweeps", options->sweeps, "List sweeps instead of jobs")->group(kSelectionOptions);
  add_examples(*list, {"cellcrush list --limit 10", "cellcrush list --filter 'state = RUNNING'",
                       "cellcrush list --sweeps --json"});
}

}  // namespace cellcrush::client
