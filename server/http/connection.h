#pragma once

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "access/gate.h"
#include "http/connect_protocol.h"
#include "http/stream.h"
#include "net/connection_limits.h"
#include "rpc/method_table.h"

namespace cellcrush::http {

/// A call of a client, unary or a stream, on one io_context with one thread, which runs until the last batch that was
/// asked for has come. The next batch is made only when it is asked for, so that a slow client costs no more memory
/// than one.
class Call final : public std::enable_shared_from_this<Call> {
 public:
  /// `timeout`: after which the call ends with DEADLINE_EXCEEDED; nothing: never.
  Call(const boost::asio::any_io_executor& executor, std::shared_ptr<rpc::MessageStream> stream,
       std::optional<std::chrono::milliseconds> timeout);
  ~Call() { stream_->cancel(); }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  /// The next batch; the last one has its `end`.
  boost::asio::awaitable<rpc::MessageStream::Batch> next();

  /// Ends the call at once; safe to repeat.
  void cancel();

 private:
  void end(const grpc::Status& status);

  boost::asio::any_io_executor executor_;
  boost::asio::steady_timer news_;  ///< expires at the deadline; cancelled on news
  std::shared_ptr<rpc::MessageStream> stream_;
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  std::optional<rpc::MessageStream::Batch> batch_;  ///< delivered
};

/// What all connections of a gateway share; outlives them.
struct GatewayParts {
  const access::Gate& gate;
  const rpc::MethodTable& methods;
  net::ConnectionLimits limits;
  std::string framing_origins;  ///< which may frame the page, separated by spaces; empty: none
  int port = 0;
  bool has_tls = false;
  bool stopping = false;
};

/// One connection of a client, served on the gateway's only thread. Owned by its own coroutine.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  /// `tls`: null for plain text; need not outlive the constructor.
  Connection(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* tls, GatewayParts& parts)
      : stream_(std::move(socket), tls), parts_(parts) {}

  /// Serves requests until either side closes.
  boost::asio::awaitable<void> serve();

  /// Closes it if no call is running, or else if `also_calls`.
  void close(bool also_calls);

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  /// Serves requests until the client or the daemon has had enough.
  boost::asio::awaitable<void> serve_requests();
  boost::asio::awaitable<bool> read(Parser& parser, bool first);
  boost::asio::awaitable<void> answer(const Request& request);
  /// A request that is answered without a call or a file.
  struct Refusal {
    unsigned http_status = 0;
    grpc::Status error;
  };
  [[nodiscard]] std::optional<Refusal> refusal_of(const Request& request) const;
  /// Null if there is none.
  [[nodiscard]] const rpc::MethodTable::Method* method_of(const Request& request) const;
  boost::asio::awaitable<void> answer_file(const Request& request);
  /// The call of this request if it may be made; else null, and the status says why.
  std::shared_ptr<Call> begin_call(const Request& request, const rpc::MethodTable::Method& method,
                                   const Encoding& encoding, grpc::Status& status);
  void end_call();
  /// Answer the call, or at once with a status that is not OK if it is null.
  boost::asio::awaitable<void> answer_unary(std::shared_ptr<Call> call, const Encoding& encoding, grpc::Status status);
  boost::asio::awaitable<void> answer_stream(std::shared_ptr<Call> call, const Encoding& encoding, grpc::Status status);
  boost::asio::awaitable<void> send(unsigned status, const std::string& type, std::string body);
  boost::asio::awaitable<void> send_error(unsigned status, const grpc::Status& error);
  boost::asio::awaitable<void> send_stream_head(const Encoding& encoding);
  boost::asio::awaitable<void> send_chunk(const std::string& data);
  /// Cancels the call as soon as the client closes its side.
  void watch_client();

  Stream stream_;
  boost::beast::flat_buffer buffer_;
  GatewayParts& parts_;
  std::shared_ptr<Call> call_;  ///< null while none runs
  bool keep_alive_ = false;
};

}  // namespace cellcrush::http
