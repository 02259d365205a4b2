#include "connection/streams.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <set>
#include <stop_token>
#include <thread>

namespace cellcrush::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::array kPauses = {250ms, 500ms, 1000ms, 2000ms, 4000ms};
constexpr auto kSilence = 60s;

// Cancels a call if the user interrupts or the server falls silent. Lives as long as the call.
class CallGuard {
 public:
  CallGuard(grpc::ClientContext& context, const Interruption& interruption)
      : last_(Clock::now()), thread_([this, &context, &interruption](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            if (interruption.wait_for(50ms) || Clock::now() - last_.load() > kSilence) return context.TryCancel();
          }
        }) {}

  void heard() { last_ = Clock::now(); }

 private:
  std::atomic<Clock::time_point> last_;
  std::jthread thread_;
};

bool may_recover(grpc::StatusCode code) {
  const ExitCode exit = exit_code_of(code);
  return exit == ExitCode::no_connection || exit == ExitCode::cut_off || code == grpc::StatusCode::RESOURCE_EXHAUSTED;
}

StreamReading read_once(const FollowedStream& stream, const Interruption& interruption) {
  grpc::ClientContext context;
  CallGuard guard(context, interruption);
  return stream.read(context, [&guard] { guard.heard(); });
}

const v1::Job* job_in(const v1::JobEvent& event) {
  if (event.has_snapshot()) return &event.snapshot().job();
  return event.has_state() ? &event.state() : nullptr;
}

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

bool follow_stream(const FollowedStream& stream, const Interruption& interruption) {
  std::size_t attempt = 0;
  while (true) {
    const StreamReading reading = read_once(stream, interruption);
    if (reading.status.ok() && reading.complete) return true;
    if (interruption.requested()) return false;
    if (!reading.status.ok() && !may_recover(reading.status.error_code())) throw stream.refusal(reading.status);
    const std::string reason = reading.status.ok() ? "the server closed the stream before " + stream.name + " ended"
                                                   : error_of(reading.status).message();
    if (reading.advanced) attempt = 0;
    if (attempt == kPauses.size()) {
      throw CommandError(ExitCode::cut_off, "lost the watch of " + stream.name + ": " + reason +
                                                "; it may still be running: `cellcrush watch " + stream.name +
                                                "` shows it again");
    }
    if (attempt == 0) stream.on_break(reason);
    if (interruption.wait_for(kPauses[attempt++])) return false;
  }
}

bool follow_job(Connection& connection, const std::string& name, bool frames, const Interruption& interruption,
                JobWatcher& watcher) {
  v1::Jobs::Stub& jobs = connection.jobs();
  v1::WatchJobRequest request;
  request.set_name(name);
  request.set_frames(frames);
  v1::Job::State state = v1::Job::JOB_STATE_UNSPECIFIED;
  const auto read = [&](grpc::ClientContext& context, const std::function<void()>& heard) {
    StreamReading reading;
    const auto reader = jobs.WatchJob(&context, request);
    v1::JobEvent event;
    while (reader->Read(&event)) {
      heard();
      reading.advanced = reading.advanced || event.sequence() > request.after_sequence();
      request.set_after_sequence(std::max(request.after_sequence(), event.sequence()));
      if (event.has_snapshot()) request.set_epoch(event.snapshot().epoch());
      if (const v1::Job* job = job_in(event)) state = job->state();
      watcher.on_event(event);
    }
    reading.status = reader->Finish();
    reading.complete = is_final(state);
    return reading;
  };
  const auto on_break = [&](const std::string& reason) { watcher.on_break(reason); };
  const auto refusal = [&](const grpc::Status& status) { return connection.error_about(name, status); };
  return follow_stream({name, read, on_break, refusal}, interruption);
}

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
