#pragma once

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "access/gate.h"
#include "http/call.h"
#include "http/connect_protocol.h"
#include "http/download.h"
#include "http/public_url.h"
#include "http/sign_in.h"
#include "http/stream.h"
#include "net/connection_limits.h"
#include "net/connection_table.h"
#include "rpc/health_service.h"
#include "rpc/method_table.h"

namespace cellcrush::http {

/// What all connections of a gateway share; outlives them.
struct GatewayParts {
  const access::Gate& gate;
  const rpc::MethodTable& methods;
  rpc::Accounts& received;
  net::ConnectionTable& table;
  const rpc::HealthBoard& board;
  net::ConnectionLimits limits;
  std::string framing_origins;  ///< which may frame the page, separated by spaces; empty: none
  PublicUrl public_url;
  bool has_tls = false;
  bool stopping = false;
};

/// One connection of a client, served on the gateway's only thread. Owned by its own coroutine.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  /// `tls`: null for plain text; need not outlive the constructor. `user`: of access::user_of_peer.
  Connection(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* tls, std::optional<uid_t> user,
             GatewayParts& parts)
      : stream_(std::move(socket), tls), user_(user), parts_(parts) {}

  /// Serves requests until either side closes.
  boost::asio::awaitable<void> serve();

  /// Closes it if no call is running, or else if `also_calls`.
  void close(bool also_calls);

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  /// Headers, or else trailers, must fit in here whole.
  static constexpr std::uint32_t kLargestHeader = 16 * 1024;
  static constexpr std::size_t kMostBuffered = kLargestHeader + 4096;

  /// Serves requests until the client or the daemon has had enough.
  boost::asio::awaitable<void> serve_requests();
  /// Takes the public path off the target, and notes how an answer is to be streamed.
  void prepare_for(Request& request);
  /// A request that is answered without a call or a file.
  struct Refusal {
    unsigned http_status = 0;
    grpc::Status error;
  };
  /// What a request may do, by its head.
  struct Permit {
    std::optional<Refusal> refusal;
    grpc::Status status;                              ///< of the gate, for a call
    access::Caller caller;                            ///< of a call
    bool is_stranger = false;                         ///< the caller's name is that of its address
    std::shared_ptr<rpc::Accounts::Charge> received;  ///< for the body of a call
  };
  boost::asio::awaitable<bool> read_head(Parser& parser, bool first);
  /// False if it cannot be answered.
  boost::asio::awaitable<bool> read_body(Parser& parser, Permit& permit);
  /// Answers with the error of a message that is too large, and is the last to do so.
  boost::asio::awaitable<void> refuse_large(const boost::beast::error_code& error);
  boost::asio::awaitable<void> answer(Request& request, Permit& permit);
  [[nodiscard]] Permit permit_for(const Request& head, std::int64_t body_bytes);
  [[nodiscard]] static std::string_view target_of(const Request& request) {
    return {request.target().data(), request.target().size()};
  }
  /// What a probe is told; nothing for the path of something else.
  [[nodiscard]] std::optional<rpc::HealthBoard::Report> report_of(const Request& request) const;
  [[nodiscard]] std::optional<Refusal> refusal_of(const Request& request) const;
  /// Null if there is none.
  [[nodiscard]] const rpc::MethodTable::Method* method_of(const Request& request) const;
  [[nodiscard]] access::HttpCredentials credentials_of(const Request& request);
  [[nodiscard]] std::string address_of_client();
  boost::asio::awaitable<void> answer_file(const Request& request);
  boost::asio::awaitable<void> answer_sign_in(const Request& request, const SignIn& sign_in);
  /// A file made by calls, with errors as text. One that comes once the file has begun cuts it off.
  boost::asio::awaitable<void> answer_download(const Request& request);
  /// The call of this request if it may be made; else null, and the status says why.
  std::shared_ptr<Call> begin_call(Request& request, Permit& permit, const rpc::MethodTable::Method& method,
                                   const Encoding& encoding, grpc::Status& status);
  std::shared_ptr<Call> begin_call(const Request& request, const std::shared_ptr<Download>& download,
                                   grpc::Status& status);
  void end_call();
  /// Answer the call, or at once with a status that is not OK if it is null.
  boost::asio::awaitable<void> answer_unary(std::shared_ptr<Call> call, const Encoding& encoding, grpc::Status status);
  boost::asio::awaitable<void> answer_stream(std::shared_ptr<Call> call, const Encoding& encoding, grpc::Status status);
  boost::asio::awaitable<void> send(unsigned status, const std::string& type, std::string body);
  boost::asio::awaitable<void> send_error(unsigned status, const grpc::Status& error);
  /// `file`: of which the body is, once its first answer is there; null: of none.
  boost::asio::awaitable<void> send_stream_head(const std::string& content_type, const Download* file = nullptr);
  boost::asio::awaitable<void> send_chunk(const std::string& data);
  boost::asio::awaitable<void> send_last_chunk();
  /// Cancels the call as soon as the client closes its side.
  void watch_client();

  Stream stream_;
  std::optional<uid_t> user_;
  boost::beast::flat_buffer buffer_{kMostBuffered};
  GatewayParts& parts_;
  std::shared_ptr<Call> call_;  ///< null while none runs
  std::string root_;            ///< of the page, relative to the address of the request
  bool keep_alive_ = false;
  bool is_head_ = false;     ///< the request asks for no body
  bool is_chunked_ = false;  ///< the answer that is being streamed; else it ends with the connection
  bool left_body_ = false;   ///< the client may still send what is not read
};

}  // namespace cellcrush::http
