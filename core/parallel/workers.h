#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace cellcrush {

/// Threads that share the loops of a step; the caller is the first of them. A loop's items are dealt out in even,
/// contiguous parts, one a thread, always to the same threads, so that their caches keep them; only a part whose thread
/// has not begun when the caller is done with its own, because the machine is busy, is taken by the caller. Beside what
/// only the caller can do, the others do pieces of something else. What is computed must not depend on the deal: then
/// the bits are the same for any number of threads.
class Workers {
 public:
  /// REQUIRES: count >= 1.
  explicit Workers(int count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

  /// Where a part of so many items starts; the part after the last starts at their end.
  [[nodiscard]] std::size_t start_of_part(std::size_t items, std::size_t part) const {
    return items * part / static_cast<std::size_t>(count());
  }

  /// Calls task(first, end) for the parts of the items 0 ... items - 1 and returns when all are done. The task must not
  /// throw.
  template <class Task>
  void parallel_for(std::size_t items, const Task& task) {
    parallel_ranges(items, 1, [&](std::size_t, std::size_t first, std::size_t end) { task(first, end); });
  }

  /// The same of task(part, first, end), with parts 0 ... count() - 1, all of which are called, and starts of parts
  /// that are multiples of `grain`.
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

  /// Calls own(), and task(piece) for pieces 0 ... pieces - 1 by any thread that has nothing else to do, and returns
  /// when all is done. Loops that own() shares go before the pieces. Neither may need what the other makes, and the
  /// task must not throw.
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
  alignas(64) std::atomic<std::uint64_t> round_{0};          // of the newest job
  alignas(64) std::atomic<int> pending_{0};                  // parts that are not done
  alignas(64) std::atomic<std::int64_t> pieces_left_{0};     // above 0: pieces that nobody has begun
  alignas(64) std::atomic<std::int64_t> pieces_pending_{0};  // that are not done
  std::vector<std::atomic<std::uint64_t>> claimed_;          // of each part, the newest round in which somebody took it
  std::atomic<bool> stopped_{false};
  std::vector<std::thread> threads_;
};

}  // namespace cellcrush
