#pragma once

#include <boost/asio.hpp>
#include <chrono>
#include <memory>
#include <optional>

#include "http/call.h"
#include "rpc/message_stream.h"

namespace cellcrush::http {

/// An open stream, on one io_context with one thread. The next batch is made only when it is asked for, so that a slow
/// client costs no more memory than one.
class StreamCall final : public AnyCall, public std::enable_shared_from_this<StreamCall> {
 public:
  /// `timeout`: after which the stream ends with DEADLINE_EXCEEDED; nothing: never.
  StreamCall(const boost::asio::any_io_executor& executor, std::shared_ptr<rpc::MessageStream> stream,
             std::optional<std::chrono::milliseconds> timeout);
  ~StreamCall() override { stream_->cancel(); }
  StreamCall(const StreamCall&) = delete;
  StreamCall& operator=(const StreamCall&) = delete;

  /// The next batch; the last one has its `end`.
  boost::asio::awaitable<rpc::MessageStream::Batch> next();

  void cancel() override;

 private:
  void end(const grpc::Status& status);

  boost::asio::any_io_executor executor_;
  boost::asio::steady_timer news_;  ///< expires at the deadline; cancelled on news
  std::shared_ptr<rpc::MessageStream> stream_;
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  std::optional<rpc::MessageStream::Batch> batch_;  ///< delivered
};

}  // namespace cellcrush::http
