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

}  // namespace cellcrush
