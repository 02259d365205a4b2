#include "connection/sweep_stream.h"

#include <algorithm>
#include <set>

#include "connection/stream_follower.h"

namespace cellcrush::client {

namespace {

// The jobs of a sweep, and which of them have ended.
class Remaining {
 public:
  void apply(const v1::WatchSweepResponse& response) {
    if (response.has_snapshot()) jobs_ = {response.snapshot().jobs().begin(), response.snapshot().jobs().end()};
    const v1::JobEvent& event = response.event();
    if (event.has_snapshot()) note(response.job(), event.snapshot().job().state());
    if (event.has_state()) note(response.job(), event.state().state());
  }

  [[nodiscard]] bool none() const {
    return !jobs_.empty() && std::includes(ended_.begin(), ended_.end(), jobs_.begin(), jobs_.end());
  }

 private:
  void note(const std::string& job, v1::Job::State state) {
    // A job that is queued again after a failure has not ended.
    is_final(state) ? (void)ended_.insert(job) : (void)ended_.erase(job);
  }

  std::set<std::string> jobs_;
  std::set<std::string> ended_;
};

}  // namespace

bool follow_sweep(Connection& connection, const std::string& name, const Interruption& interruption,
                  SweepWatcher& watcher) {
  v1::Sweeps::Stub& sweeps = connection.sweeps();
  v1::WatchSweepRequest request;
  request.set_name(name);
  Remaining remaining;
  const auto read = [&](grpc::ClientContext& context, const std::function<void()>& heard) {
    StreamReading reading;
    const auto reader = sweeps.WatchSweep(&context, request);
    v1::WatchSweepResponse response;
    while (reader->Read(&response)) {
      heard();
      if (!response.resume_token().empty() && response.resume_token() != request.resume_token()) {
        request.set_resume_token(response.resume_token());
        reading.advanced = true;
      }
      remaining.apply(response);
      watcher.on_response(response);
    }
    reading.status = reader->Finish();
    reading.complete = remaining.none();
    return reading;
  };
  const auto on_break = [&](const std::string& reason) { watcher.on_break(reason); };
  const auto refusal = [&](const grpc::Status& status) { return connection.error_about(name, status); };
  return follow_stream({name, read, on_break, refusal}, interruption);
}

}  // namespace cellcrush::client
