#include "connection/stream_follower.h"

#include <array>
#include <atomic>
#include <chrono>
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

}  // namespace cellcrush::client
