#include "connection/streams.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <functional>
#include <memory>
#include <set>
#include <stop_token>
#include <system_error>
#include <thread>

namespace cellcrush::client {
namespace {

// A signal handler may only do what is async-signal-safe: it writes a byte, and the reading end stays readable.
int pipe_ends[2] = {-1, -1};
struct sigaction former_interrupt = {};
struct sigaction former_terminate = {};

/// ms on the monotonic clock; 0: none yet.
std::atomic<std::int64_t> first_signal = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

// `timeout` sends a signal to its command and then to the command's group: the command gets it twice.
constexpr std::int64_t kSameRequest = 500;  // ms

extern "C" void on_interrupt(int signal) {
  const int saved = errno;
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t time = 1000 * static_cast<std::int64_t>(now.tv_sec) + now.tv_nsec / 1'000'000;
  std::int64_t first = 0;
  if (first_signal.compare_exchange_strong(first, time)) {
    const char byte = 1;
    [[maybe_unused]] const ssize_t written = write(pipe_ends[1], &byte, 1);
  } else if (time - first >= kSameRequest) {
    std::signal(signal, SIG_DFL);
    raise(signal);
  }
  errno = saved;
}

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kSilence = 60s;

// Cancels a call if the user interrupts or the server falls silent. Lives as long as the call.
class CallGuard {
 public:
  CallGuard(grpc::ClientContext& context, const Interruption& interruption)
      : last_(Clock::now()),
        over_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
        thread_([this, &context, &interruption](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(last_.load() + kSilence - Clock::now());
            if (left.count() <= 0 || interruption.wait_for(left, over_)) return context.TryCancel();
          }
        }) {}
  ~CallGuard() {
    thread_.request_stop();
    eventfd_write(over_, 1);
    thread_.join();
    close(over_);
  }
  CallGuard(const CallGuard&) = delete;
  CallGuard& operator=(const CallGuard&) = delete;

  void heard() { last_ = Clock::now(); }

 private:
  std::atomic<Clock::time_point> last_;
  int over_;  ///< eventfd, readable once the call is over
  std::jthread thread_;
};

bool may_recover(grpc::StatusCode code) {
  const ExitCode exit = exit_code_of(code);
  return exit == ExitCode::no_connection || exit == ExitCode::cut_off || code == grpc::StatusCode::RESOURCE_EXHAUSTED;
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

// A stream that can be resumed after the last message received.
template <typename Event>
struct FollowedStream {
  std::string name;  // of the job or sweep
  std::function<std::unique_ptr<grpc::ClientReader<Event>>(grpc::ClientContext&)> open;
  std::function<bool(const Event&)> take;  // whether the event is a new one
  std::function<bool()> is_complete;       // everything expected was received
};

template <typename Event>
bool follow(Connection& connection, const FollowedStream<Event>& stream, const Interruption& interruption,
            Watcher<Event>& watcher) {
  for (std::size_t attempt = 0;; ++attempt) {
    grpc::ClientContext context;
    connection.prepare(context);
    CallGuard guard(context, interruption);
    const auto reader = stream.open(context);
    Event event;
    while (reader->Read(&event)) {
      guard.heard();
      if (stream.take(event)) attempt = 0;
      watcher.on_event(event);
    }
    const grpc::Status status = reader->Finish();
    if (status.ok() && stream.is_complete()) return true;
    if (interruption.requested()) return false;
    if (connection.meets_another_server())
      throw CommandError(ExitCode::cut_off, "lost the watch of " + stream.name + ": " + error_of(status).message());
    if (!status.ok() && !may_recover(status.error_code())) throw connection.error_about(stream.name, status);
    const std::string reason =
        status.ok() ? "the server closed the stream before " + stream.name + " ended" : error_of(status).message();
    if (attempt == kPauses.size()) {
      throw CommandError(ExitCode::cut_off, "lost the watch of " + stream.name + ": " + reason +
                                                "; it may still be running: `cellcrush watch " + stream.name +
                                                "` shows it again");
    }
    if (attempt == 0) watcher.on_break(reason);
    if (interruption.wait_for(kPauses[attempt])) return false;
  }
}

}  // namespace

Interruption::Interruption() {
  if (pipe2(pipe_ends, O_CLOEXEC | O_NONBLOCK) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  struct sigaction action = {};
  first_signal = 0;
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &former_interrupt);
  sigaction(SIGTERM, &action, &former_terminate);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &former_interrupt, nullptr);
  sigaction(SIGTERM, &former_terminate, nullptr);
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

bool Interruption::wait_for(std::chrono::milliseconds time, int over) const {
  std::array readers = {pollfd{pipe_ends[0], POLLIN, 0}, pollfd{over, POLLIN, 0}};
  return poll(readers.data(), readers.size(), static_cast<int>(time.count())) > 0 && readers[0].revents != 0;
}

bool follow_job(Connection& connection, const std::string& name, const Interruption& interruption,
                Watcher<v1::JobEvent>& watcher) {
  v1::Jobs::Stub& jobs = connection.jobs();
  v1::WatchJobRequest request;
  request.set_name(name);
  v1::Job::State state = v1::Job::JOB_STATE_UNSPECIFIED;
  const auto take = [&](const v1::JobEvent& event) {
    const bool is_new = event.sequence() > request.after_sequence();
    request.set_after_sequence(std::max(request.after_sequence(), event.sequence()));
    if (event.has_snapshot()) request.set_epoch(event.snapshot().epoch());
    if (const v1::Job* job = job_in(event)) state = job->state();
    return is_new;
  };
  const FollowedStream<v1::JobEvent> stream{
      name, [&](grpc::ClientContext& context) { return jobs.WatchJob(&context, request); }, take,
      [&] { return is_final(state); }};
  return follow(connection, stream, interruption, watcher);
}

bool follow_sweep(Connection& connection, const std::string& name, const Interruption& interruption,
                  Watcher<v1::WatchSweepResponse>& watcher) {
  v1::Sweeps::Stub& sweeps = connection.sweeps();
  v1::WatchSweepRequest request;
  request.set_name(name);
  Remaining remaining;
  const auto take = [&](const v1::WatchSweepResponse& response) {
    const bool is_new = !response.resume_token().empty() && response.resume_token() != request.resume_token();
    if (is_new) request.set_resume_token(response.resume_token());
    remaining.apply(response);
    return is_new;
  };
  const FollowedStream<v1::WatchSweepResponse> stream{
      name, [&](grpc::ClientContext& context) { return sweeps.WatchSweep(&context, request); }, take,
      [&] { return remaining.none(); }};
  return follow(connection, stream, interruption, watcher);
}

}  // namespace cellcrush::client
