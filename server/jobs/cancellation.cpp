#include "jobs/cancellation.h"

#include <sys/socket.h>

#include <chrono>

namespace cellcrush::jobs {
namespace {

constexpr std::chrono::seconds kToReact{2};
constexpr std::chrono::seconds kToCloseTheResult{60};

}  // namespace

Cancellation::Cancellation(int socket, const Child& child, const std::stop_token& wish)
    : socket_(socket), child_(child), on_wish_(wish, [this] { begin(); }) {}

void Cancellation::acknowledged() {
  {
    const std::scoped_lock lock(mutex_);
    acknowledged_ = true;
  }
  changed_.notify_all();
}

void Cancellation::begin() {
  shutdown(socket_, SHUT_WR);
  limit_ = std::jthread([this](const std::stop_token& ended) { enforce(ended); });
}

void Cancellation::enforce(const std::stop_token& ended) {
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, ended, kToReact, [this] { return acknowledged_; }))
    changed_.wait_for(lock, ended, kToCloseTheResult, [] { return false; });
  if (!ended.stop_requested()) child_.kill_now();
}

}  // namespace cellcrush::jobs
