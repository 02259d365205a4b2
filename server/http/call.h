#pragma once

#include <boost/asio.hpp>
#include <chrono>
#include <memory>
#include <optional>

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

}  // namespace cellcrush::http
