#include "jobs/housekeeping.h"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <string>
#include <utility>

#include "store/lattice_file.h"

namespace cellcrush::jobs {
namespace {

// Seconds of the service clock that a killed daemon may lose.
constexpr std::int64_t kNoteAfter = 600;
// The gradual corrections of a synchronized clock never reach it.
constexpr std::chrono::seconds kLeastJump{10};

}  // namespace

void Housekeeping::work(const std::stop_token& stop) {
  std::string logged;
  bool has_more = false;
  do {
    has_more = false;
    try {
      parts_.journal_is_whole(!parts_.journal.is_damaged());
      check_disk();
      has_more = delete_ended(stop);
      check_clocks();
      logged.clear();
    } catch (const std::exception& error) {
      if (std::exchange(logged, error.what()) != error.what())
        spdlog::error("Housekeeping failed and will be retried: {}", error.what());
    }
    run_posted();
  } while (has_more ? !stop.stop_requested() : wait_for_next_round(stop));
}

void Housekeeping::post(std::function<void()> work) {
  {
    const MutexLock lock(mutex_);
    work_ = std::move(work);
  }
  posted_.notify_all();
}

void Housekeeping::run_posted() {
  std::function<void()> work;
  {
    const MutexLock lock(mutex_);
    work.swap(work_);
  }
  if (work) work();
}

bool Housekeeping::wait_for_next_round(const std::stop_token& stop) {
  const auto next = std::chrono::steady_clock::now() + parts_.interval;
  while (std::chrono::steady_clock::now() < next && !stop.stop_requested()) {
    {
      MutexLock lock(mutex_);
      posted_.wait_until(lock, stop, next, [this]() CELLCRUSH_REQUIRES(mutex_) { return work_ != nullptr; });
    }
    run_posted();
  }
  return !stop.stop_requested();
}

void Housekeeping::check_disk() {
  const auto shortage = parts_.admission.low_disk();
  parts_.queues.hold_for_low_disk(shortage);
  if (!shortage && parts_.folder.keep_ballast()) parts_.queues.try_now(Shortage::full_disk);
}

void Housekeeping::check_clocks() {
  // The wall clock, when set, advances differently from the uptime.
  const auto offset = parts_.clocks.wall() - parts_.clocks.uptime();
  if (const auto jump = offset - std::exchange(clock_offset_, offset); std::chrono::abs(jump) >= kLeastJump) {
    const auto seconds = std::chrono::round<std::chrono::seconds>(jump).count();
    spdlog::warn("The wall clock was set {} by {} s. Timestamps of new events follow it; retention of jobs does not.",
                 seconds > 0 ? "forward" : "back", std::abs(seconds));
  }
  const std::int64_t now = parts_.journal.service_seconds();
  if (now < noted_ + kNoteAfter) return;
  parts_.journal.note_service_clock();
  noted_ = now;
}

bool Housekeeping::delete_ended(const std::stop_token& stop) {
  const auto given_up = [this, &stop] {
    run_posted();
    return stop.stop_requested();
  };
  store::remove_unused_lattices(parts_.folder.lattices());
  parts_.deletion.finish_sweeps(given_up);
  retention_.measure(given_up);
  return retention_.enforce(given_up);
}

}  // namespace cellcrush::jobs
