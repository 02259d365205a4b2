#include "rpc/watched_job.h"

#include <utility>

#include "error_table.h"
#include "rpc/find_job.h"
#include "rpc/request_limits.h"

namespace cellcrush::rpc {

WatchedJob::WatchedJob(store::JournalReader& journal, watch::Hub& hub, const v1::WatchJobRequest& request)
    : name_(request.name()) {
  const auto status = answer([&] {
    const std::int64_t job = find_job(journal, request.name()).number;
    check_epoch(journal.epoch(), request.epoch());
    source_.emplace(journal, hub, job, request.after_sequence(),
                    watch::WatchCursor::Wanted{request.frames(), true, request.encoding()});
    return grpc::Status::OK;
  });
  if (!status.ok()) refused_ = status;
}

void WatchedJob::open(const std::function<void()>& wake) {
  if (!source_) return;
  source_->open(wake);
  is_open_ = true;
}

void WatchedJob::close() {
  if (std::exchange(is_open_, false)) source_->close();
}

std::optional<v1::WatchJobsResponse> WatchedJob::next() {
  if (refused_) return end(*std::exchange(refused_, std::nullopt));
  if (!source_) return std::nullopt;
  std::optional<v1::JobEvent> event;
  const auto status = answer([&] {
    event = source_->next();
    return grpc::Status::OK;
  });
  if (!status.ok()) return end(status);
  if (!event) return source_->ended() ? std::optional(end(grpc::Status::OK)) : std::nullopt;
  v1::WatchJobsResponse out;
  out.mutable_watched()->set_job(name_);
  *out.mutable_watched()->mutable_event() = *std::move(event);
  return out;
}

v1::WatchJobsResponse WatchedJob::end(const grpc::Status& status) {
  close();
  source_.reset();
  v1::WatchJobsResponse out;
  out.mutable_watched_end()->set_job(name_);
  auto& sent = *out.mutable_watched_end()->mutable_status();
  if (!sent.ParseFromString(status.error_details())) sent.Clear();
  sent.set_code(status.error_code());
  sent.set_message(status.error_message());
  return out;
}

}  // namespace cellcrush::rpc
