#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#include "mutex.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Lets several threads write on one connection and makes concurrent writes durable with one commit. Waiting for the
/// disk takes far longer than writing. Thread-safe.
class GroupCommit {
 public:
  /// Receives the duration of a commit in seconds, on the committing thread.
  using Committed = std::function<void(double seconds)>;
  using Step = std::function<void()>;

  /// `database` outlives this object, and nothing else writes to it.
  explicit GroupCommit(Database& database, Committed on_commit = {});
  GroupCommit(const GroupCommit&) = delete;
  GroupCommit& operator=(const GroupCommit&) = delete;

  /// Runs `body` within a transaction, one writer at a time, on this or another thread; returns once its statements are
  /// durable. Rethrows the error of `body` or of the commit. Nothing of this writer is then in the database. A body
  /// must not call run. Without a body, only takes its turn: proof that writers get theirs.
  void run(const Step& body);

  /// Writers that wait for the next commit.
  [[nodiscard]] std::size_t waiting_count() const;

 private:
  struct Write {
    const Step& body;
    std::exception_ptr error;
    bool done = false;
  };

  void commit(const std::vector<Write*>& batch);
  void do_write(Write& write);

  Database& database_;
  Committed on_commit_;
  mutable Mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Write*> waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  bool committing_ CELLCRUSH_GUARDED_BY(mutex_) = false;
};

}  // namespace cellcrush::store
