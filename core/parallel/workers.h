#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace cellcrush {

/// Threads that share the loops of a step; the caller is the first of them. The items of a loop are divided into even,
/// contiguous parts, one per thread. A part always goes to the same thread, so that its data stays in the cache of that
/// thread. One exception: if the machine is busy and a thread has not begun its part when the caller has finished its
/// own, the caller takes over. While the caller does work that only it can do, the others can do pieces of another job.
/// Results must not depend on this distribution; they then have the same bits for any number of threads.
class Workers {
 public:
  /// REQUIRES: count >= 1.
  explicit Workers(int count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

  /// Start of a part of `items` items. The part after the last one starts at their end.
  [[nodiscard]] std::size_t start_of_part(std::size_t items, std::size_t part) const {
    return items * part / static_cast<std::size_t>(count());
  }

  /// Calls task(first, end) for the parts of the items 0 ... items - 1. Returns when all are done. The task must not
  /// throw.
  template <class Task>
  void parallel_for(std::size_t items, const Task& task) {
    parallel_ranges(items, 1, [&](std::size_t, std::size_t first, std::size_t end) { task(first, end); });
  }

  /// The same for task(part, first, end), with parts 0 ... count() - 1, all of which are called. Parts start at
  /// multiples of `grain`.
  template <class Task>
  void parallel_ranges(std::size_t items, std::size_t grain, const Task& task) {
    if (threads_.empty()) {
      task(std::size_t{0}, std::size_t{0}, items);
      return;
    }
    run({&task, items, grain, [](const void* shared, std::size_t part, std::size_t first, std::size_t end) {
           (*static_cast<const Task*>(shared))(part, first, end);
         }});
  }

  /// Calls own(), while any idle thread calls task(piece) for pieces 0 ... pieces - 1. Returns when all is done. Loops
  /// that own() shares have priority over the pieces. Neither may depend on results of the other, and the task must not
  /// throw.
  template <class Task, class Own>
  void parallel_overlap(std::size_t pieces, const Task& task, const Own& own) {
    begin_pieces({&task, [](const void* shared, std::size_t piece) { (*static_cast<const Task*>(shared))(piece); }},
                 pieces);
    const FinishPieces finish{*this};  // also where own() throws
    own();
  }

 private:
  struct Job {
    const void* task = nullptr;
    std::size_t items = 0;
    std::size_t grain = 1;
    void (*call)(const void* task, std::size_t part, std::size_t first, std::size_t end) = nullptr;
  };

  struct PieceJob {
    const void* task = nullptr;
    void (*call)(const void* task, std::size_t piece) = nullptr;
  };

  struct FinishPieces {
    Workers& workers;
    ~FinishPieces() { workers.finish_pieces(); }
  };

  void run(const Job& job);
  void begin_pieces(const PieceJob& job, std::size_t pieces);
  void finish_pieces();
  bool do_piece();
  std::uint64_t begin_round();
  void do_part(std::size_t part);
  bool claim(std::size_t part, std::uint64_t round);
  void work(std::size_t part);

  Job job_;
  PieceJob piece_job_;
  alignas(64) std::atomic<std::uint64_t> round_{0};          // number of the newest round
  alignas(64) std::atomic<int> pending_{0};                  // parts not yet done
  alignas(64) std::atomic<std::int64_t> pieces_left_{0};     // if above 0: pieces that no thread has begun
  alignas(64) std::atomic<std::int64_t> pieces_pending_{0};  // pieces not yet done
  std::vector<std::atomic<std::uint64_t>> claimed_;          // of each part, the newest round in which it was claimed
  std::atomic<bool> stopped_{false};
  std::vector<std::thread> threads_;
};

/// Bytes of the last-level cache that a run may count on. At most 32 MB, as larger ones are shared by many cores; 32 MB
/// if the machine does not report a size. Affects speed only.
std::size_t last_cache_bytes();

/// Steps over items in a row; each step is some items (`lag`) behind the step before:
///
///     step 0      item 0   1   2   3   4   5 ...
///     step 1                   0   1   2   3 ...
///     step 2                           0   1 ...
///
/// Tasks are begun column by column, but no thread waits for the end of a column. A step begins its next item when it
/// has done the item before and the step before is `lag` items ahead. At most `at_once` steps are in progress; later
/// steps begin when the first ones have ended.
class Wavefront {
 public:
  /// REQUIRES: steps, items, lag, at_once >= 1.
  Wavefront(std::size_t steps, std::size_t items, std::size_t lag, std::size_t at_once);

  /// Calls visit(step, index of the item) for tasks that no thread has begun, until none are left. Any number of
  /// threads may call it, each once. Results of a task are visible to the tasks that follow it in the order above.
  template <class Visit>
  void advance(const Visit& visit) {
    for (std::size_t i = next_.fetch_add(1, std::memory_order_relaxed); i < tasks_.size();
         i = next_.fetch_add(1, std::memory_order_relaxed)) {
      const auto [step, index] = tasks_[i];
      wait_for(tasks_[i]);
      visit(step, index);
      done_[step].store(index + 1, std::memory_order_release);
    }
  }

 private:
  struct Task {
    std::size_t step;
    std::size_t index;
  };

  /// Waits until all tasks are done that a task follows.
  void wait_for(const Task& task) const;

  std::size_t items_;
  std::size_t lag_;
  std::size_t at_once_;
  std::vector<Task> tasks_;                     // no task precedes one that it waits for, so no thread waits forever
  std::atomic<std::size_t> next_{0};            // next task that no thread has begun
  std::vector<std::atomic<std::size_t>> done_;  // number of items done, of each step
};

}  // namespace cellcrush
