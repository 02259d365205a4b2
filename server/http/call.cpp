#include "http/call.h"

#include <utility>

namespace cellcrush::http {

namespace asio = boost::asio;

Call::Call(const asio::any_io_executor& executor, std::shared_ptr<rpc::MessageStream> stream,
           std::optional<std::chrono::milliseconds> timeout)
    : executor_(executor), news_(executor), stream_(std::move(stream)) {
  if (timeout) deadline_ = std::chrono::steady_clock::now() + *timeout;
}

asio::awaitable<rpc::MessageStream::Batch> Call::next() {
  if (!batch_) {
    // The executor counts as work, so that the io_context is there until the batch has come.
    auto executor = asio::prefer(executor_, asio::execution::outstanding_work.tracked);
    stream_->ask([self = shared_from_this(), executor](rpc::MessageStream::Batch batch) mutable {
      asio::post(executor, [self = std::move(self), batch = std::move(batch)]() mutable {
        if (!self->batch_) self->batch_ = std::move(batch);
        self->news_.cancel();
      });
    });
  }
  while (!batch_) {
    news_.expires_at(deadline_);
    boost::system::error_code error;
    co_await news_.async_wait(asio::redirect_error(asio::use_awaitable, error));
    if (!error && !batch_) end({grpc::StatusCode::DEADLINE_EXCEEDED, "Deadline Exceeded"});
  }
  co_return *std::exchange(batch_, std::nullopt);
}

void Call::cancel() { end({grpc::StatusCode::CANCELLED, "The client cancelled the call."}); }

void Call::end(const grpc::Status& status) {
  stream_->cancel();
  batch_ = rpc::MessageStream::Batch{{}, status};
  news_.cancel();
}

}  // namespace cellcrush::http
