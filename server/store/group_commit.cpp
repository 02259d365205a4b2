#include "store/group_commit.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cellcrush::store {

GroupCommit::GroupCommit(Database& database, Committed on_commit)
    : database_(database), on_commit_(std::move(on_commit)) {}

void GroupCommit::run(const Step& body) {
  Write own{body, nullptr};
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
    const bool has_bodies =
        std::any_of(batch.begin(), batch.end(), [](const Write* write) { return bool(write->body); });
    const auto start = std::chrono::steady_clock::now();
    transaction.commit();
    if (on_commit_ && has_bodies)
      on_commit_(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  } catch (...) {
    // A body may have failed because of another body's writes, which have vanished.
    for (Write* write : batch) write->error = std::current_exception();
  }
}

// Rolls back only the writes of a failed body.
void GroupCommit::do_write(Write& write) {
  if (!write.body) return;
  Statement(database_, "SAVEPOINT own").run();
  try {
    write.body();
  } catch (...) {
    // A full disk ends the whole transaction.
    if (!database_.in_transaction()) throw;
    Statement(database_, "ROLLBACK TO own").run();
    write.error = std::current_exception();
  }
  Statement(database_, "RELEASE own").run();
}

}  // namespace cellcrush::store
