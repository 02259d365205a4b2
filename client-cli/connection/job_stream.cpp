#include "connection/job_stream.h"

#include <array>
#include <atomic>
#include <stop_token>
#include <thread>

namespace cellcrush::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::array kPauses = {250ms, 500ms, 1000ms, 2000ms, 4000ms};
constexpr auto kSilence = 60s;

// Ends a call when the user interrupts or the server falls silent. Lives as long as the call.
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

const v1::Job* job_in(const v1::JobEvent& event) {
  if (event.has_snapshot()) return &event.snapshot().job();
  return event.has_state() ? &event.state() : nullptr;
}

bool may_recover(grpc::StatusCode code) {
  const ExitCode exit = exit_code_of(code);
  return exit == ExitCode::no_connection || exit == ExitCode::cut_off || code == grpc::StatusCode::RESOURCE_EXHAUSTED;
}

}  // namespace

bool follow_job(Connection& connection, const std::string& name, bool frames, const Interruption& interruption,
                JobWatcher& watcher) {
  v1::Jobs::Stub& jobs = connection.jobs();
  v1::WatchJobRequest request;
  request.set_name(name);
  request.set_frames(frames);
  std::size_t attempt = 0;
  v1::JobState state = v1::JOB_STATE_UNSPECIFIED;
  while (true) {
    grpc::ClientContext context;
    grpc::Status status;
    {
      CallGuard guard(context, interruption);
      const auto reader = jobs.WatchJob(&context, request);
      v1::JobEvent event;
      while (reader->Read(&event)) {
        guard.heard();
        if (event.sequence() > request.after_sequence()) attempt = 0;
        request.set_after_sequence(std::max(request.after_sequence(), event.sequence()));
        if (const v1::Job* job = job_in(event)) state = job->state();
        watcher.on_event(event);
      }
      status = reader->Finish();
    }
    if (status.ok() && is_final(state)) return true;
    if (interruption.requested()) return false;
    if (!status.ok() && !may_recover(status.error_code())) throw error_of(status);
    const std::string reason =
        status.ok() ? "the server ended the stream before the job's end" : error_of(status).message();
    if (attempt == kPauses.size()) {
      throw CommandError(ExitCode::cut_off, "the watch of " + name + " was cut off: " + reason +
                                                "; the job may still run: `cellcrush watch " + name + "` picks it up");
    }
    if (attempt == 0) watcher.on_break(reason);
    if (interruption.wait_for(kPauses[attempt++])) return false;
  }
}

}  // namespace cellcrush::client
