#include "rpc/watch_reactor.h"

#include <utility>

#include "rpc/error_table.h"

namespace cellcrush::rpc {

grpc::ServerWriteReactor<v1::JobEvent>* WatchReactor::start(const Parts& parts, std::int64_t job,
                                                            const v1::WatchJobRequest& request) {
  auto channel = parts.hub.open(job);
  watch::WatchCursor cursor(parts.reader, job, channel, request.after_sequence(), request.frames());
  auto reactor = std::make_shared<WatchReactor>(parts, std::move(channel), std::move(cursor));
  reactor->self_ = reactor;
  reactor->subscription_ =
      reactor->channel_->subscribe([&pump = parts.pump, weak = std::weak_ptr<WatchReactor>(reactor)] {
        if (auto alive = weak.lock()) pump.schedule(alive);
      });
  parts.pump.add(reactor);
  return reactor.get();
}

WatchReactor::WatchReactor(const Parts& parts, std::shared_ptr<watch::Channel> channel, watch::WatchCursor cursor)
    : pump_(parts.pump),
      bookmark_interval_(parts.bookmark_interval),
      channel_(std::move(channel)),
      cursor_(std::move(cursor)) {}

void WatchReactor::run() {
  Action action = Action::none;
  {
    const std::scoped_lock lock(mutex_);
    action = decide();
  }
  if (action == Action::write) StartWrite(&message_);
  if (action == Action::finish) Finish(status_);
}

WatchReactor::Action WatchReactor::decide() {
  if (writing_ || finished_) return Action::none;
  if (cancelled_) return close({grpc::StatusCode::CANCELLED, "The watcher is gone."});
  try {
    auto next = cursor_.next();
    if (!next && cursor_.ended()) return close(grpc::Status::OK);
    if (!next && pump_.draining()) {
      return close({grpc::StatusCode::UNAVAILABLE, "The daemon ends. Watch again with after_sequence " +
                                                       std::to_string(cursor_.bookmark().sequence()) +
                                                       " once it is back."});
    }
    if (!next && Clock::now() - last_write_ >= bookmark_interval_) next = cursor_.bookmark();
    if (!next) return Action::none;
    message_ = *std::move(next);
  } catch (const std::exception& error) {
    return close(status_of(error));
  }
  writing_ = true;
  last_write_ = Clock::now();
  return Action::write;
}

WatchReactor::Action WatchReactor::close(grpc::Status status) {
  status_ = std::move(status);
  finished_ = true;
  return Action::finish;
}

void WatchReactor::OnWriteDone(bool ok) {
  {
    const std::scoped_lock lock(mutex_);
    writing_ = false;
    if (!ok) cancelled_ = true;
  }
  pump_.schedule(self_);
}

void WatchReactor::OnCancel() {
  {
    const std::scoped_lock lock(mutex_);
    cancelled_ = true;
  }
  pump_.schedule(self_);
}

void WatchReactor::OnDone() {
  channel_->unsubscribe(subscription_);
  // The last reference goes with `self`, or with the pump if it still holds one.
  const auto self = std::move(self_);
}

}  // namespace cellcrush::rpc
