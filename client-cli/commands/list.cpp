#include <fmt/format.h>

#include <algorithm>

#include "commands/commands.h"
#include "terminal/job_text.h"
#include "terminal/json_text.h"
#include "terminal/sweep_text.h"

namespace cellcrush::client {

namespace {

constexpr int kPage = 1000;

struct ListOptions {
  std::string filter;
  std::string order;
  int limit = 0;  ///< 0: all
  bool sweeps = false;
};

// Joins the pages of a list into one answer without a token, up to `limit` entries.
template <typename Response, typename Stub, typename Request>
Response list_all(Connection& connection, Stub& stub,
                  grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*), Request request,
                  int limit, int (*size)(const Response&)) {
  Response all;
  while (true) {
    request.set_page_size(limit > 0 ? std::min(kPage, limit - size(all)) : kPage);
    Response page = connection.call(stub, method, request);
    const std::string next = page.next_page_token();
    page.clear_next_page_token();
    all.MergeFrom(page);
    const bool enough = limit > 0 && size(all) >= limit;
    if (enough || next.empty() || next == request.page_token()) return all;
    request.set_page_token(next);
  }
}

void list_jobs(Session& session, const ListOptions& options) {
  Connection& connection = session.connection();
  v1::ListJobsRequest request;
  request.set_filter(options.filter);
  request.set_order_by(options.order);
  const auto size = [](const v1::ListJobsResponse& all) { return all.jobs_size(); };
  const auto all = list_all<v1::ListJobsResponse>(connection, connection.jobs(), &v1::Jobs::Stub::ListJobs, request,
                                                  options.limit, size);
  session.json ? print_json(all) : fmt::print("{}", job_list_text({all.jobs().begin(), all.jobs().end()}));
}

void list_sweeps(Session& session, const ListOptions& options) {
  if (!options.filter.empty() || !options.order.empty()) {
    throw CommandError(ExitCode::refused, "list --sweeps: sweeps have no --filter and no --order; leave them out");
  }
  Connection& connection = session.connection();
  const auto size = [](const v1::ListSweepsResponse& all) { return all.sweeps_size(); };
  const auto all = list_all<v1::ListSweepsResponse>(connection, connection.sweeps(), &v1::Sweeps::Stub::ListSweeps,
                                                    v1::ListSweepsRequest(), options.limit, size);
  session.json ? print_json(all) : fmt::print("{}", sweep_list_text({all.sweeps().begin(), all.sweeps().end()}));
}

}  // namespace

void add_list_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* list = add_command(app, session, "list", "List the jobs or the sweeps, newest first", [&session, options] {
    options->sweeps ? list_sweeps(session, *options) : list_jobs(session, *options);
    return ExitCode::done;
  });
  list->add_option("--filter", options->filter, "Only jobs that match, such as 'state = RUNNING'");
  list->add_option("--order,--order-by", options->order, "Another order, such as 'create_time'");
  list->add_option("--limit", options->limit, "At most so many (default: all)")->check(CLI::PositiveNumber);
  list->add_flag("--sweeps", options->sweeps, "List sweeps");
}

}  // namespace cellcrush::client
