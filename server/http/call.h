#pragma once

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <boost/asio.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace cellcrush::http {

/// A call that a connection waits for.
class AnyCall {
 public:
  virtual ~AnyCall() = default;
  /// Ends the call at once; safe to repeat.
  virtual void cancel() = 0;
};

/// One unary call to the daemon's own gRPC server, by bytes. Used on one io_context with one thread, which it keeps
/// running until gRPC is done with it.
class Call final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>,
                   public AnyCall,
                   public std::enable_shared_from_this<Call> {
 public:
  struct Request {
    std::string path;           ///< "/cellcrush.v1.Jobs/GetJob"
    std::string message;        ///< binary
    std::string authorization;  ///< empty: none
    std::optional<std::chrono::milliseconds> timeout;
  };

  explicit Call(const boost::asio::any_io_executor& executor) : work_(executor), news_(executor) {}

  /// `channel` is the call's own.
  void start(std::shared_ptr<grpc::Channel> channel, const Request& request);

  /// The next message; nothing at the end.
  boost::asio::awaitable<std::optional<std::string>> next();

  /// How it ended. Waits for the end.
  boost::asio::awaitable<grpc::Status> status();

  void cancel() override;

 private:
  void OnReadDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;
  void release();
  boost::asio::awaitable<void> wait();

  boost::asio::executor_work_guard<boost::asio::any_io_executor> work_;
  boost::asio::steady_timer news_;  ///< never expires; cancelled on every change
  std::shared_ptr<Call> self_;      ///< until OnDone
  std::optional<grpc::GenericStub> stub_;
  grpc::ClientContext context_;
  grpc::ByteBuffer request_;
  grpc::ByteBuffer message_;  ///< gRPC's while reading_
  std::optional<grpc::Status> status_;
  bool reading_ = false;
  bool ended_ = false;  ///< no message follows
  bool held_ = true;    ///< the hold keeps OnDone behind the last message
};

}  // namespace cellcrush::http
