#pragma once

#include <functional>
#include <string>
#include <type_traits>

#include "connection/connection.h"

namespace cellcrush::client {

/// Calls a paged method and joins the pages into one response without a token. Calls `wants_more` before each page; it
/// may change the request, such as its page_size. Throws CommandError.
template <typename Stub, typename Request, typename Response>
Response call_for_pages(Connection& connection, Stub& stub,
                        grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*), Request request,
                        const std::function<bool(const std::type_identity_t<Response>& all,
                                                 std::type_identity_t<Request>& request)>& wants_more = {}) {
  Response all;
  while (!wants_more || wants_more(all, request)) {
    Response page = connection.call(stub, method, request);
    const std::string next = page.next_page_token();
    page.clear_next_page_token();
    all.MergeFrom(page);
    if (next.empty() || next == request.page_token()) break;
    request.set_page_token(next);
  }
  return all;
}

/// All samples of a job.
v1::GetHistoryResponse fetch_history(Connection& connection, const std::string& job);

/// A job, a sweep.
v1::Job fetch_job(Connection& connection, const std::string& name);
v1::Sweep fetch_sweep(Connection& connection, const std::string& name);

/// The whole table of a sweep.
v1::SweepTable fetch_table(Connection& connection, const std::string& sweep);

}  // namespace cellcrush::client
