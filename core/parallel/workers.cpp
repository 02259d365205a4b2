#include "parallel/workers.h"

#include <algorithm>

#include "parallel/spin.h"

namespace cellcrush {

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

}  // namespace cellcrush
