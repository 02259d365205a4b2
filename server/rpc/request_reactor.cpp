#include "rpc/request_reactor.h"

#include <fmt/format.h>

namespace cellcrush::rpc {

void RequestReactor::read(std::shared_ptr<Accounts::Charge> room) {
  room_ = std::move(room);
  StartRead(&bytes_);
  Stage waiting = Stage::waiting;
  stage_.compare_exchange_strong(waiting, Stage::reading);  // unless the request has come meanwhile
}

void RequestReactor::OnReadDone(bool is_read) {
  if (stage_.exchange(Stage::moved_on) == Stage::moved_on) return;
  set_due(OpenCalls::Clock::time_point::max());
  auto room = std::move(room_);
  if (!is_read) {
    return end(context_.IsCancelled()
                   ? grpc::Status(grpc::StatusCode::CANCELLED, "The client cancelled the call.")
                   : grpc::Status(grpc::StatusCode::INVALID_ARGUMENT,
                                  "The call has no request message. Send one, even if it is empty."));
  }
  room->set(static_cast<std::int64_t>(bytes_.Length()));
  on_request(bytes_, std::move(room));
}

void RequestReactor::end_late() {
  if (!is_due()) return;  // the request has just come
  Stage reading = Stage::reading;
  if (open_.withdraw(*this) || stage_.compare_exchange_strong(reading, Stage::moved_on)) {
    end({grpc::StatusCode::DEADLINE_EXCEEDED,
         fmt::format("The call's request did not come within {:.2g} s. Send it without delay, and fewer large ones at "
                     "once.",
                     std::chrono::duration<double>(patience_.request).count())});
  } else if (stage_ == Stage::moved_on) {
    cut();
  }
}

void RequestReactor::end(const grpc::Status& status) {
  limit_end();
  note_end(status);
  Finish(status);
}

void RequestReactor::OnCancel() {
  if (open_.withdraw(*this)) end(grpc::Status::CANCELLED);
}

void RequestReactor::OnDone() {
  cut_.end();
  open_.remove(*this);
}

}  // namespace cellcrush::rpc
