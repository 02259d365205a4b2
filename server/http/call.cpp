#include "http/call.h"

#include <utility>
#include <vector>

namespace cellcrush::http {
namespace {

namespace asio = boost::asio;

std::string text_of(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  std::string out;
  if (!buffer.Dump(&slices).ok()) return out;
  out.reserve(buffer.Length());
  for (const auto& slice : slices) out.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return out;
}

}  // namespace

void Call::start(std::shared_ptr<grpc::Channel> channel, const Request& request) {
  stub_.emplace(std::move(channel));
  self_ = shared_from_this();
  if (!request.authorization.empty()) context_.AddMetadata("authorization", request.authorization);
  if (request.timeout) context_.set_deadline(std::chrono::system_clock::now() + *request.timeout);
  const grpc::Slice slice(request.message);
  request_ = grpc::ByteBuffer(&slice, 1);
  stub_->PrepareBidiStreamingCall(&context_, request.path, {}, this);
  AddHold();
  StartWriteLast(&request_, {});
  StartCall();
}

asio::awaitable<std::optional<std::string>> Call::next() {
  if (ended_) co_return std::nullopt;
  reading_ = true;
  StartRead(&message_);
  while (reading_) co_await wait();
  if (ended_) co_return std::nullopt;
  std::string out = text_of(message_);
  message_.Clear();
  co_return out;
}

asio::awaitable<grpc::Status> Call::status() {
  while (!status_) co_await wait();
  co_return *status_;
}

asio::awaitable<void> Call::wait() {
  news_.expires_at(asio::steady_timer::time_point::max());
  boost::system::error_code error;
  co_await news_.async_wait(asio::redirect_error(asio::use_awaitable, error));
}

void Call::cancel() {
  context_.TryCancel();
  if (!reading_) release();
}

void Call::release() {
  ended_ = true;
  if (std::exchange(held_, false)) RemoveHold();
}

void Call::OnReadDone(bool ok) {
  asio::post(work_.get_executor(), [this, ok, self = shared_from_this()] {
    reading_ = false;
    if (!ok) release();
    news_.cancel();
  });
}

void Call::OnDone(const grpc::Status& status) {
  asio::post(work_.get_executor(), [this, status, self = shared_from_this()] {
    status_ = status;
    self_.reset();
    work_.reset();
    news_.cancel();
  });
}

}  // namespace cellcrush::http
