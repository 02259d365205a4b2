#include "store/group_commit.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cellcrush::store {

GroupCommit::GroupCommit(Database& database, Committed on_commit)
    : database_(database), on_commit_(std::move(on_commit)) {}

void GroupCommit::run(const Step& body, const Step& undo) {
  Write own{body, undo, nullptr};
  MutexLock lock(mutex_);
  waiting_.push_back(&own);
  changed_.wait(lock, [&]() CELLCRUSH_REQUIRES(mutex_) { return own.done || !committing_; });
  if (!own.done) {
    // Commits for all writers that arrived during the previous commit.
    committing_ = true;
    const auto batch = std::exchange(waiting_, {});
    lock.unlock();
    commit(batch);
    lock.lock();
    committing_ = false;
    for (Write* write : batch) write->done = true;
    changed_.notify_all();
  }
  if (own.error) std::rethrow_exception(own.error);
}

std::size_t GroupCommit::waiting_count() const {
  const MutexLock lock(mutex_);
  return waiting_.size();
}

void GroupCommit::commit(const std::vector<Write*>& batch) {
  try {
    Transaction transaction(database_);
    for (Write* write : batch) do_write(*write);
    const auto start = std::chrono::steady_clock::now();
    transaction.commit();
    if (on_commit_) on_commit_(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  } catch (...) {
    const auto error = std::current_exception();
    std::for_each(batch.rbegin(), batch.rend(), [&error](Write* write) { fail(*write, error); });
  }
}

// Rolls back only the writes of a failed body.
void GroupCommit::do_write(Write& write) {
  Statement(database_, "SAVEPOINT own").run();
  try {
    write.body();
  } catch (...) {
    // A full disk ends the whole transaction.
    if (!database_.in_transaction()) throw;
    Statement(database_, "ROLLBACK TO own").run();
    fail(write, std::current_exception());
  }
  Statement(database_, "RELEASE own").run();
}

// A body may fail because of another body's writes, which vanish if the commit fails: the commit's error then counts.
void GroupCommit::fail(Write& write, std::exception_ptr error) noexcept {
  const bool is_undone = write.error != nullptr;
  write.error = std::move(error);
  if (write.undo && !is_undone) write.undo();
}

}  // namespace cellcrush::store
