#include "store/group_commit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "error.h"
#include "programs/temporary_folder.h"

namespace cellcrush::store {
namespace {

class GroupCommitTest : public ::testing::Test {
 protected:
  GroupCommitTest() { database_.execute("CREATE TABLE numbers (number INTEGER PRIMARY KEY)"); }

  void insert(int number) { Statement(database_, "INSERT INTO numbers VALUES (?1)").bind(1, number).run(); }

  // What another connection sees, which is what is committed.
  [[nodiscard]] std::int64_t count() const {
    Database other(folder_.path() / "database");
    Statement read(other, "SELECT COUNT(*) FROM numbers");
    read.step();
    return read.integer(0);
  }

  // The first commit lasts until so many writers wait for the second.
  GroupCommit::Committed hold_first(const GroupCommit& writes, std::size_t writers) {
    return [this, &writes, writers](double) {
      if (++commits_ > 1) return;
      while (writes.waiting_count() < writers) std::this_thread::yield();
    };
  }

  // Writes 0, in a commit that lasts until all of `others` wait; returns when all have ended.
  void write_together(GroupCommit& writes, const std::vector<std::function<void()>>& others) {
    std::vector<std::jthread> writers;
    writers.emplace_back([&] { writes.run([&] { insert(0); }); });
    while (commits_ == 0) std::this_thread::yield();
    for (const auto& other : others) writers.emplace_back(other);
  }

  testing::TemporaryFolder folder_;
  Database database_{folder_.path() / "database"};
  std::atomic<int> commits_ = 0;
};

TEST_F(GroupCommitTest, OneThatFailsTakesBackItsOwnAndTheOthersStay) {
  GroupCommit writes(database_, hold_first(writes, 6));
  std::vector<std::function<void()>> others;
  for (int i = 1; i <= 6; ++i) {
    const auto write = [&, i] {
      writes.run([&] {
        insert(i);
        if (i % 2 == 0) throw std::runtime_error("no");
        if (i == 3) insert(0);
      });
    };
    others.emplace_back([i, write] {
      if (i % 2 == 0) {
        EXPECT_THROW(write(), std::runtime_error);
      } else if (i == 3) {
        EXPECT_THROW(write(), ServiceError) << "The number is there already.";
      } else {
        write();
      }
    });
  }
  write_together(writes, others);
  EXPECT_EQ(commits_, 2) << "What is written during a commit is committed together.";
  EXPECT_EQ(count(), 3) << "0, 1 and 5.";
}

// The verdict of a body may come from what another one wrote.
TEST_F(GroupCommitTest, WhenTheCommitFailsAllAreToldThatAndTheNextOneGoesOn) {
  GroupCommit writes(database_, hold_first(writes, 2));
  // A deferred constraint is looked at by the commit.
  database_.execute("CREATE TABLE children (number INTEGER REFERENCES numbers DEFERRABLE INITIALLY DEFERRED)");
  write_together(
      writes,
      {[&] { EXPECT_THROW(writes.run([] { throw std::runtime_error("its own"); }), ServiceError); },
       [&] { EXPECT_THROW(writes.run([&] { database_.execute("INSERT INTO children VALUES (7)"); }), ServiceError); }});
  writes.run([&] { insert(1); });
  EXPECT_EQ(count(), 2);
}

}  // namespace
}  // namespace cellcrush::store
