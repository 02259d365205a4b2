#include "parallel/workers.h"

#include <hwy/cache_control.h>
#include <unistd.h>

#include <algorithm>

#include "cellcrush/tuning.h"

namespace cellcrush {
namespace {

/// Waits until the condition holds, for at most kSpinCount checks. Returns whether it holds.
template <class Condition>
bool spin_until(const Condition& holds) {
  for (int check = 0; check < kSpinCount; ++check) {
    if (holds()) {
      return true;
    }
    hwy::Pause();
  }
  return false;
}

/// Waits until the condition holds; the thread yields in between.
template <class Condition>
void wait_until(const Condition& holds) {
  while (!spin_until(holds)) {
    std::this_thread::yield();
  }
}

}  // namespace

Workers::Workers(int count) : claimed_(static_cast<std::size_t>(count)) {
  for (std::size_t part = 1; part < claimed_.size(); ++part) {
    threads_.emplace_back([this, part] { work(part); });
  }
}

Workers::~Workers() {
  stopped_.store(true);
  begin_round();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void Workers::run(const Job& job) {
  job_ = job;
  pending_.store(static_cast<int>(claimed_.size()), std::memory_order_relaxed);
  const std::uint64_t round = begin_round();
  for (std::size_t part = 0; part < claimed_.size(); ++part) {
    if (claim(part, round)) {
      do_part(part);
    }
  }
  wait_until([this] { return pending_.load(std::memory_order_acquire) == 0; });
}

/// Begins a round and returns its number; wakes sleeping threads.
std::uint64_t Workers::begin_round() {
  const std::uint64_t round = round_.fetch_add(1, std::memory_order_release) + 1;
  round_.notify_all();
  return round;
}

void Workers::begin_pieces(const PieceJob& job, std::size_t pieces) {
  piece_job_ = job;
  pieces_pending_.store(static_cast<std::int64_t>(pieces), std::memory_order_relaxed);
  pieces_left_.store(static_cast<std::int64_t>(pieces), std::memory_order_release);
  // A round whose parts are all claimed; it only wakes sleeping threads.
  for (std::atomic<std::uint64_t>& claimed : claimed_) {
    claimed.store(round_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  begin_round();
}

void Workers::finish_pieces() {
  while (do_piece()) {
  }
  wait_until([this] { return pieces_pending_.load(std::memory_order_acquire) == 0; });
}

/// Does one piece that no thread has begun, if there is one. A thread that comes late either finds none left or begins
/// one of the next pieces, whose job it then sees.
bool Workers::do_piece() {
  if (pieces_left_.load(std::memory_order_relaxed) <= 0) {
    return false;
  }
  const std::int64_t left = pieces_left_.fetch_sub(1, std::memory_order_acq_rel);
  if (left <= 0) {
    return false;
  }
  piece_job_.call(piece_job_.task, static_cast<std::size_t>(left - 1));
  pieces_pending_.fetch_sub(1, std::memory_order_acq_rel);
  return true;
}

void Workers::do_part(std::size_t part) {
  const std::size_t grains = (job_.items + job_.grain - 1) / job_.grain;
  const auto start_of = [&](std::size_t p) { return std::min(job_.items, start_of_part(grains, p) * job_.grain); };
  job_.call(job_.task, part, start_of(part), start_of(part + 1));
  pending_.fetch_sub(1, std::memory_order_acq_rel);
}

bool Workers::claim(std::size_t part, std::uint64_t round) {
  std::uint64_t before = claimed_[part].load(std::memory_order_relaxed);
  return before < round && claimed_[part].compare_exchange_strong(before, round, std::memory_order_acq_rel);
}

void Workers::work(std::size_t part) {
  for (std::uint64_t done = 0;;) {
    const auto has_round = [&] { return round_.load(std::memory_order_acquire) != done; };
    const auto has_work = [&] { return has_round() || pieces_left_.load(std::memory_order_relaxed) > 0; };
    if (!spin_until(has_work)) {
      round_.wait(done, std::memory_order_acquire);
    }
    if (!has_round()) {
      do_piece();
      continue;
    }
    done = round_.load(std::memory_order_acquire);
    // Checked after the round, because the round of the destructor has no job.
    if (stopped_.load()) {
      return;
    }
    // All parts of a finished round are claimed, so the job of a newly claimed part still exists.
    if (claim(part, done)) {
      do_part(part);
    }
  }
}

std::size_t last_cache_bytes() {
  static const std::size_t kBytes = [] {
    constexpr std::size_t kMostOfOneProcess = std::size_t{32} << 20;
    const long found = sysconf(_SC_LEVEL3_CACHE_SIZE);
    return found > 0 ? std::min(static_cast<std::size_t>(found), kMostOfOneProcess) : kMostOfOneProcess;
  }();
  return kBytes;
}

Wavefront::Wavefront(std::size_t steps, std::size_t items, std::size_t lag, std::size_t at_once)
    : items_(items), lag_(lag), at_once_(at_once), done_(steps) {
  std::vector<std::size_t> first(steps, 0);  // the column in which each step begins
  for (std::size_t step = 1; step < steps; ++step) {
    const std::size_t room = step >= at_once ? first[step - at_once] + items : 0;
    first[step] = std::max(first[step - 1] + lag, room);
  }
  tasks_.reserve(steps * items);
  for (std::size_t column = 0; column < first.back() + items; ++column) {
    for (std::size_t step = 0; step < steps && first[step] <= column; ++step) {
      if (column - first[step] < items) {
        tasks_.push_back({step, column - first[step]});
      }
    }
  }
}

void Wavefront::wait_for(const Task& task) const {
  const auto has_done = [&](std::size_t step, std::size_t items) {
    return done_[step].load(std::memory_order_acquire) >= std::min(items, items_);
  };
  wait_until([&] {
    return has_done(task.step, task.index) && (task.step == 0 || has_done(task.step - 1, task.index + lag_)) &&
           (task.step < at_once_ || has_done(task.step - at_once_, items_));
  });
}

}  // namespace cellcrush
