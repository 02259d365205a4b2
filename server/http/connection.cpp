#include "http/connection.h"

#include <absl/strings/numbers.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "error_table.h"
#include "web/page_files.h"

namespace cellcrush::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace bhttp = beast::http;
using Field = bhttp::field;

constexpr std::chrono::seconds kFarewell{1};
constexpr std::chrono::seconds kPatience{20};  // with a client that reads nothing of its answer
constexpr const char* kText = "text/plain; charset=utf-8";
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors ";

template <class Body>
bhttp::response<Body> new_response(unsigned status, bool keep_alive, const char* caching, const std::string& epoch) {
  bhttp::response<Body> out(static_cast<bhttp::status>(status), 11);
  out.set("X-Content-Type-Options", "nosniff");
  out.set("Referrer-Policy", "no-referrer");
  out.set(Field::cache_control, caching);
  out.set(rpc::kEpochHeader, epoch);
  out.keep_alive(keep_alive);
  return out;
}

std::optional<std::chrono::milliseconds> read_timeout(const bhttp::request<bhttp::string_body>& request) {
  constexpr std::size_t kMostDigits = 10;
  const std::string text(request["Connect-Timeout-Ms"]);
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  if (text.size() > kMostDigits || !absl::SimpleAtoi(text, &value) || value < 0)
    throw ServiceError(ServiceError::Kind::invalid, "Connect-Timeout-Ms must be a number of at most 10 digits.");
  return std::chrono::milliseconds(value);
}

rpc::MessageStream::Encode encode_for(const Encoding& encoding) {
  return [encoding](const google::protobuf::Message& message, std::string& to) {
    const std::string bytes = encoding.json ? json_of(message) : message.SerializeAsString();
    if (encoding.stream) begin_envelope(0, bytes.size(), to);
    to += bytes;
  };
}

rpc::MessageStream::Begin begin_for(const Encoding& encoding) {
  if (encoding.json) return nullptr;
  return [](std::size_t bytes, std::string& to) { begin_envelope(0, bytes, to); };
}

bool asks_for_compression(const bhttp::request<bhttp::string_body>& request, const Encoding& encoding) {
  const auto name = request[encoding.stream ? "Connect-Content-Encoding" : "Content-Encoding"];
  const bool flagged = encoding.stream && !request.body().empty() &&
                       (static_cast<std::uint8_t>(request.body().front()) & kCompressed) != 0;
  return flagged || (!name.empty() && name != "identity");
}

}  // namespace

asio::awaitable<void> Connection::serve() {
  const auto self = shared_from_this();
  try {
    stream_.plain().expires_after(parts_.limits.handshake);
    co_await stream_.begin();
    co_await serve_requests();
    stream_.plain().expires_after(kFarewell);
    co_await stream_.end();
  } catch (const boost::system::system_error&) {
    // The client is gone or too slow.
  } catch (const std::exception& error) {
    spdlog::error("An HTTP connection was closed: {}", error.what());
  }
  if (call_) call_->cancel();
  call_.reset();
  close(true);
}

asio::awaitable<void> Connection::answer(Request& request, Permit& permit) {
  if (const auto& refusal = permit.refusal) {
    if (request.method() == bhttp::verb::post) parts_.methods.note_end(target_of(request), refusal->error.error_code());
    // Only calls have an error as JSON.
    if (request.method() == bhttp::verb::get || is_head_) {
      co_await send(refusal->http_status, kText, refusal->error.error_message() + '\n');
    } else {
      co_await send_error(refusal->http_status, refusal->error);
    }
  } else if (request.method() != bhttp::verb::post) {
    if (const auto report = report_of(request)) {
      co_await send(report->is_well ? 200 : 503, kText, report->words + '\n');
    } else if (const auto sign_in = read_sign_in(target_of(request))) {
      co_await answer_sign_in(request, *sign_in);
    } else if (is_download(target_of(request))) {
      co_await answer_download(request);
    } else {
      co_await answer_file(request);
    }
  } else {
    const auto& method = *method_of(request);
    const Encoding encoding{*parse_content_type(request[Field::content_type])};
    grpc::Status status;
    auto call = begin_call(request, permit, method, encoding, status);
    if (encoding.stream) {
      co_await answer_stream(std::move(call), encoding, status);
    } else {
      co_await answer_unary(std::move(call), encoding, status);
    }
  }
}

std::shared_ptr<Call> Connection::begin_call(Request& request, Permit& permit, const rpc::MethodTable::Method& method,
                                             const Encoding& encoding, grpc::Status& status) {
  status = permit.status;
  if (status.ok() && asks_for_compression(request, encoding)) {
    status = {grpc::StatusCode::UNIMPLEMENTED, "Compressed requests are not accepted. Send them uncompressed."};
    parts_.methods.note_end(target_of(request), status.error_code());
  }
  if (!status.ok()) return nullptr;
  const auto body = std::make_shared<const std::string>(std::move(request.body()));
  std::optional<std::chrono::milliseconds> timeout;
  std::string_view message = *body;
  status = cellcrush::answer([&] {
    timeout = read_timeout(request);
    if (encoding.stream) message = read_envelope(*body);
  });
  if (!status.ok()) {
    parts_.methods.note_end(target_of(request), status.error_code());
    return nullptr;
  }
  status = cellcrush::answer([&] {
    rpc::Incoming incoming{permit.caller,
                           std::string(request[rpc::kEpochHeader]),
                           nullptr,
                           static_cast<std::int64_t>(message.size()),
                           std::move(permit.received),
                           encode_for(encoding),
                           begin_for(encoding)};
    incoming.decode = [body, message, json = encoding.json](google::protobuf::Message& to) {
      return decode(message, json, to);
    };
    call_ = std::make_shared<Call>(stream_.get_executor(), method.open(incoming), timeout);
  });
  if (call_) watch_client();
  return call_;
}

std::shared_ptr<Call> Connection::begin_call(const Request& request, const std::shared_ptr<Download>& download,
                                             grpc::Status& status) {
  rpc::Incoming incoming;
  incoming.epoch = std::string(request[rpc::kEpochHeader]);
  status = parts_.gate.check_http_call(download->method, credentials_of(request), incoming.caller);
  if (!status.ok()) return nullptr;
  parts_.table.know(stream_.plain().socket().native_handle(), incoming.caller.name);
  status = cellcrush::answer([&] {
    incoming.decode = [download](google::protobuf::Message& message) {
      download->ask(message);
      return true;
    };
    incoming.encode = [download](const google::protobuf::Message& message, std::string& to) {
      download->write(message, to);
    };
    call_ = std::make_shared<Call>(stream_.get_executor(), parts_.methods.find(download->method)->open(incoming),
                                   std::nullopt);
  });
  if (call_) watch_client();
  return call_;
}

void Connection::end_call() {
  call_.reset();
  stream_.plain().socket().cancel();
}

asio::awaitable<void> Connection::answer_unary(std::shared_ptr<Call> call, const Encoding& encoding,
                                               grpc::Status status) {
  std::string message;
  std::shared_ptr<rpc::Accounts::Charge> charge;  // until the client has read the answer
  if (call) {
    auto batch = co_await call->next();
    end_call();
    message = std::move(batch.bytes);
    status = *batch.end;
    charge = std::move(batch.charge);
  }
  if (status.ok()) {
    co_await send(200, content_type_of(encoding), std::move(message));
  } else {
    co_await send_error(http_status(status.error_code()), status);
  }
}

asio::awaitable<void> Connection::answer_stream(std::shared_ptr<Call> call, const Encoding& encoding,
                                                grpc::Status status) {
  co_await send_stream_head(content_type_of(encoding));
  if (call) {
    while (true) {
      const auto batch = co_await call->next();
      if (!batch.bytes.empty()) co_await send_chunk(batch.bytes);
      if (!batch.end) continue;
      status = *batch.end;
      break;
    }
    end_call();
  }
  const std::string end = envelope(kEndOfStream, end_of_stream_json(status));
  co_await send_chunk(end);
  co_await send_last_chunk();
}

void Connection::watch_client() {
  auto& socket = stream_.plain().socket();
  socket.async_wait(asio::ip::tcp::socket::wait_read, [self = shared_from_this()](beast::error_code error) {
    if (error || !self->call_) return;
    // Either the client is gone, or it sends a request before it has the answer, which no client of Connect does.
    self->keep_alive_ = false;
    self->call_->cancel();
    self->close(true);
  });
}

asio::awaitable<void> Connection::answer_sign_in(const Request& request, const SignIn& sign_in) {
  // Some programs look at a link before a person opens it.
  const bool opens = request.method() == bhttp::verb::get;
  const auto session = opens ? parts_.gate.sessions().redeem(sign_in.code, user_) : std::nullopt;
  if (opens && !session) {
    co_await send(403, kText, "This link was used before, or is older than 5 minutes. Run `cellcrush open` again.\n");
    co_return;
  }
  const bool is_secure = parts_.has_tls || parts_.public_url.origin.starts_with("https://");
  auto response = new_response<bhttp::string_body>(303, keep_alive_, "no-store", parts_.methods.epoch());
  response.set(Field::location, "./" + sign_in.page);
  const std::string path = parts_.public_url.path + "/";
  if (session) response.set(Field::set_cookie, session_cookie(*session, parts_.methods.epoch(), path, is_secure));
  response.content_length(0);
  stream_.plain().expires_after(parts_.limits.idle);
  co_await bhttp::async_write(stream_, response, asio::use_awaitable);
}

asio::awaitable<void> Connection::answer_file(const Request& request) {
  const web::PageFile* file = web::find_page_file(request.target());
  const std::string start = web::is_start(*file) ? web::start_below(*file, root_) : "";
  const bool is_small = start.empty() && web::accepts_gzip(request[Field::accept_encoding]);
  const std::string_view small = is_small ? web::gzip_of(*file) : std::string_view();
  const std::string_view bytes = !start.empty() ? start : small.empty() ? file->bytes : small;
  const std::string tag = web::entity_tag(bytes);
  const bool known = request[Field::if_none_match] == tag;
  auto response = new_response<bhttp::string_body>(known ? 304 : 200, keep_alive_, "no-cache", parts_.methods.epoch());
  response.set(Field::etag, tag);
  response.set(Field::vary, "Accept-Encoding");
  const std::string& framing = parts_.framing_origins;
  response.set("Content-Security-Policy", kContentPolicy + (framing.empty() ? "'none'" : framing));
  if (!known) {
    response.set(Field::content_type, web::content_type_of_file(file->name));
    if (!small.empty()) response.set(Field::content_encoding, "gzip");
    if (request.method() == bhttp::verb::get) response.body() = bytes;
    response.content_length(bytes.size());
  }
  stream_.plain().expires_after(parts_.limits.idle);
  co_await bhttp::async_write(stream_, response, asio::use_awaitable);
}

asio::awaitable<void> Connection::answer_download(const Request& request) {
  std::shared_ptr<Download> download;
  auto status = cellcrush::answer([&] { download = open_download(target_of(request)); });
  if (download && request[Field::if_range].empty()) download->begin_at(request[Field::range]);
  const bool wants_body = request.method() == bhttp::verb::get;
  bool has_begun = false;
  while (status.ok()) {
    auto call = begin_call(request, download, status);
    for (bool ended = !call; !ended;) {
      const auto batch = co_await call->next();
      ended = batch.end.has_value();
      if (ended) status = *batch.end;
      if (status.ok() && download->first > 0 && download->size && download->first >= *download->size)
        status = {grpc::StatusCode::OUT_OF_RANGE, "The file ends there."};
      if (!status.ok()) break;
      if (!std::exchange(has_begun, true)) co_await send_stream_head(download->content_type, download.get());
      if (!wants_body) break;
      if (!batch.bytes.empty()) co_await send_chunk(batch.bytes);
    }
    if (call) end_call();
    if (!status.ok() || !wants_body || !download->has_more()) break;
  }
  if (!has_begun) {
    const bool is_past_end = status.error_code() == grpc::StatusCode::OUT_OF_RANGE;
    co_await send(is_past_end ? 416 : http_status(status.error_code()), kText, status.error_message() + '\n');
  } else if (!status.ok()) {
    keep_alive_ = false;
  } else if (wants_body) {
    co_await send_last_chunk();
  }
}

asio::awaitable<void> Connection::send(unsigned status, const std::string& type, std::string body) {
  auto response = new_response<bhttp::string_body>(status, keep_alive_, "no-store", parts_.methods.epoch());
  response.set(Field::content_type, type);
  if (status == 405) response.set(Field::allow, "GET, HEAD, POST");
  response.content_length(body.size());
  if (!is_head_) response.body() = std::move(body);
  bhttp::response_serializer<bhttp::string_body> serializer(response);
  while (!serializer.is_done()) {
    stream_.plain().expires_after(kPatience);
    co_await bhttp::async_write_some(stream_, serializer, asio::use_awaitable);
  }
}

asio::awaitable<void> Connection::send_error(unsigned status, const grpc::Status& error) {
  std::string body = error_json(error);
  co_await send(status, "application/json", std::move(body));
}

asio::awaitable<void> Connection::send_stream_head(const std::string& content_type, const Download* file) {
  const bool has_size = file != nullptr && file->size;
  keep_alive_ = keep_alive_ && (is_chunked_ || has_size);
  is_chunked_ = is_chunked_ && !has_size;
  auto response = new_response<bhttp::empty_body>(200, keep_alive_, "no-store", parts_.methods.epoch());
  response.set(Field::content_type, content_type);
  if (file != nullptr) describe(*file, response);
  response.set("X-Accel-Buffering", "no");  // nginx passes each chunk on at once
  if (!has_size) response.chunked(is_chunked_);
  bhttp::response_serializer<bhttp::empty_body> serializer(response);
  stream_.plain().expires_after(parts_.limits.idle);
  co_await bhttp::async_write_header(stream_, serializer, asio::use_awaitable);
}

asio::awaitable<void> Connection::send_chunk(const std::string& data) {
  stream_.plain().expires_after(parts_.limits.idle);
  if (is_chunked_) {
    co_await asio::async_write(stream_, bhttp::make_chunk(asio::buffer(data)), asio::use_awaitable);
  } else {
    co_await asio::async_write(stream_, asio::buffer(data), asio::use_awaitable);
  }
}

asio::awaitable<void> Connection::send_last_chunk() {
  if (is_chunked_) co_await asio::async_write(stream_, bhttp::make_chunk_last(), asio::use_awaitable);
}

void Connection::close(bool also_calls) {
  if (call_ && !also_calls) return;
  if (call_) call_->cancel();
  stream_.plain().close();
}

}  // namespace cellcrush::http
