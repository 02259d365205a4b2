#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "access/unix_user.h"
#include "error_table.h"
#include "http/browser_rules.h"
#include "http/connection.h"
#include "web/page_files.h"

// How a connection reads its requests: the head first, and of the body no more than this caller may send.

namespace cellcrush::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace bhttp = beast::http;
using Field = bhttp::field;

constexpr std::uint64_t kLargestBody = 4 * 1024 * 1024 + 5;  // a message of gRPC's largest size in its envelope
constexpr std::uint64_t kLargestUnasked = 64 * 1024;         // of a body that nobody wants
constexpr std::chrono::seconds kLinger{1};

std::string path_of(const google::protobuf::MethodDescriptor& method) {
  return "/" + method.service()->full_name() + "/" + method.name();
}

std::vector<std::string> values_of(const bhttp::fields& fields, Field name) {
  std::vector<std::string> out;
  const auto [first, last] = fields.equal_range(name);
  for (auto field = first; field != last; ++field) out.emplace_back(field->value());
  return out;
}

}  // namespace

asio::awaitable<void> Connection::serve_requests() {
  for (bool first = true; first || keep_alive_; first = false) {
    Parser parser;
    parser.header_limit(kLargestHeader);
    parser.body_limit(boost::none);  // of the head alone; that of the body depends on the caller
    if (!co_await read_head(parser, first)) break;
    prepare_for(parser.get());
    const std::uint64_t size = parser.chunked() ? kLargestBody : parser.content_length().value_or(0);
    auto permit = permit_for(parser.get(), static_cast<std::int64_t>(std::min(size, kLargestBody)));
    if (!co_await read_body(parser, permit)) break;
    co_await answer(parser.get(), permit);
    keep_alive_ = keep_alive_ && !parts_.stopping;
  }
  if (!left_body_) co_return;
  // A socket that is closed with unread bytes takes the answer back.
  stream_.plain().expires_after(kLinger);
  buffer_.clear();
  while (true) co_await stream_.async_read_some(buffer_.prepare(kLargestHeader), asio::use_awaitable);
}

void Connection::prepare_for(Request& request) {
  keep_alive_ = request.keep_alive();
  is_chunked_ = request.version() >= 11;  // HTTP/1.0, as of nginx by default, has no chunks
  is_head_ = request.method() == bhttp::verb::head;
  auto asked = find_asked_path(target_of(request), parts_.public_url);
  request.target(asked.target);
  root_ = std::move(asked.root);
}

asio::awaitable<bool> Connection::read_head(Parser& parser, bool first) {
  stream_.plain().expires_after(first ? parts_.limits.handshake : parts_.limits.idle);
  if (buffer_.size() == 0) {
    const std::size_t size = co_await stream_.async_read_some(buffer_.prepare(4096), asio::use_awaitable);
    buffer_.commit(size);
  }
  stream_.plain().expires_after(parts_.limits.handshake);
  beast::error_code error;
  co_await bhttp::async_read_header(stream_, buffer_, parser, asio::redirect_error(asio::use_awaitable, error));
  is_head_ = false;
  if (error) co_await refuse_large(error);
  co_return !error;
}

asio::awaitable<bool> Connection::read_body(Parser& parser, Permit& permit) {
  const bool is_wanted = permit.received != nullptr;
  const std::uint64_t most = is_wanted && !permit.is_stranger ? kLargestBody : kLargestUnasked;
  beast::error_code error;
  if (parser.content_length().value_or(0) > most) {
    error = bhttp::error::body_limit;
  } else {
    parser.body_limit(most);
    co_await bhttp::async_read(stream_, buffer_, parser, asio::redirect_error(asio::use_awaitable, error));
  }
  if (!error) {
    if (is_wanted) permit.received->set(static_cast<std::int64_t>(parser.get().body().size()));
    co_return true;
  }
  keep_alive_ = false;
  if (error == bhttp::error::body_limit && !is_wanted) {
    left_body_ = true;
    co_return true;  // the refusal is the answer
  }
  co_await refuse_large(error);
  co_return false;
}

asio::awaitable<void> Connection::refuse_large(const beast::error_code& error) {
  keep_alive_ = false;
  const bool is_body = error == bhttp::error::body_limit;
  if (!is_body && error != bhttp::error::header_limit && error != bhttp::error::buffer_overflow) co_return;
  left_body_ = true;
  const char* words =
      is_body ? "The body is larger than this method takes." : "The headers or trailers are larger than 16 KiB.";
  co_await send_error(is_body ? 413 : 431, {grpc::StatusCode::RESOURCE_EXHAUSTED, words});
}

Connection::Permit Connection::permit_for(const Request& head, std::int64_t body_bytes) {
  Permit out;
  out.refusal = refusal_of(head);
  if (out.refusal || head.method() != bhttp::verb::post) return out;
  out.status = parts_.gate.check_http_call(path_of(*method_of(head)->descriptor), credentials_of(head), out.caller);
  if (!out.status.ok()) return out;
  out.is_stranger = out.caller.name.empty();
  if (out.is_stranger) {
    // The methods that are open to everybody need small requests.
    body_bytes = std::min<std::int64_t>(body_bytes, kLargestUnasked);
    out.caller.name = user_ == geteuid() ? access::own_user() : address_of_client();
  } else {
    parts_.table.know(stream_.plain().socket().native_handle(), out.caller.name);
  }
  out.received = parts_.received.take(out.caller.name, body_bytes);
  if (!out.received) {
    out.status = status_of(rpc::too_many_bytes(out.caller.name));
    parts_.methods.note_end(target_of(head), out.status.error_code());
  }
  return out;
}

std::string Connection::address_of_client() {
  beast::error_code error;
  const auto end = stream_.plain().socket().remote_endpoint(error);
  sockaddr_storage address{};
  std::memcpy(&address, end.data(), std::min(end.size(), sizeof(address)));
  return net::peer_of(address);
}

access::HttpCredentials Connection::credentials_of(const Request& request) {
  return {values_of(request, Field::authorization),
          session_of(values_of(request, Field::cookie), parts_.methods.epoch()), user_, stream_.client_certificate()};
}

std::optional<rpc::HealthBoard::Report> Connection::report_of(const Request& request) const {
  const auto path = target_of(request).substr(0, target_of(request).find('?'));
  if (path == "/healthz") return parts_.board.progress();
  if (path == "/readyz") return parts_.board.readiness();
  return std::nullopt;
}

const rpc::MethodTable::Method* Connection::method_of(const Request& request) const {
  return parts_.methods.find(target_of(request));
}

std::optional<Connection::Refusal> Connection::refusal_of(const Request& request) const {
  using grpc::StatusCode;
  if (request.count(Field::host) != 1 || request.count(Field::origin) > 1) {
    return Refusal{400,
                   {StatusCode::PERMISSION_DENIED, "One Host header, and at most one Origin header, must be sent."}};
  }
  // A link on another site may open the page, but not sign its visitor in as somebody. The content policy of the page
  // names the sites that may frame it.
  const auto place = request["Sec-Fetch-Dest"];
  const bool is_visit = request.method() == bhttp::verb::get && request["Sec-Fetch-Mode"] == "navigate" &&
                        !read_sign_in(target_of(request)) &&
                        (place == "document" || (place == "iframe" && !parts_.framing_origins.empty()));
  const BrowserHeaders headers{request[Field::host], request[Field::origin],
                               is_visit ? std::string_view() : std::string_view(request["Sec-Fetch-Site"])};
  if (const auto refusal = check_browser(headers, parts_.has_tls, parts_.public_url))
    return Refusal{refusal->status, {StatusCode::PERMISSION_DENIED, refusal->why}};
  const auto* method = method_of(request);
  if (request.method() == bhttp::verb::get || request.method() == bhttp::verb::head) {
    if (method != nullptr) return Refusal{405, {StatusCode::UNIMPLEMENTED, "Use POST for calls."}};
    if (!report_of(request) && !read_sign_in(target_of(request)) && !is_download(target_of(request)) &&
        web::find_page_file(request.target()) == nullptr)
      return Refusal{404,
                     {StatusCode::NOT_FOUND,
                      "There is no such page. The web page is at /. A job has /jobs/NUMBER/history.csv and "
                      "/jobs/NUMBER/result.h5, a sweep has /sweeps/NUMBER.csv."}};
    return std::nullopt;
  }
  if (request.method() != bhttp::verb::post)
    return Refusal{405, {StatusCode::UNIMPLEMENTED, "Use POST for calls and GET for the page."}};
  if (method == nullptr) return Refusal{404, {StatusCode::UNIMPLEMENTED, "There is no such method."}};
  const auto encoding = parse_content_type(request[Field::content_type]);
  const bool is_stream = method->descriptor->server_streaming();
  if (encoding && encoding->stream == is_stream) return std::nullopt;
  const std::string kind = is_stream ? "application/connect+" : "application/";
  return Refusal{415,
                 {StatusCode::INVALID_ARGUMENT,
                  method->descriptor->name() + " requires the content type " + kind + "json or " + kind + "proto."}};
}

}  // namespace cellcrush::http
