#include "store/group_commit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "error.h"
#include "server/temporary_folder.h"

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

  testing::TemporaryFolder folder_;
  Database database_{folder_.path() / "database"};
  std::atomic<int> commits_ = 0;
};

TEST_F(GroupCommitTest, WhatIsWrittenDuringACommitIsCommittedTogetherAndSeenOnReturn) {
  GroupCommit writes(database_, hold_first(writes, 20));
  std::vector<std::jthread> writers;
  writers.emplace_back([&] { writes.run([&] { insert(0); }); });
  while (commits_ == 0) std::this_thread::yield();
  for (int i = 1; i <= 20; ++i) {
    writers.emplace_back([&, i] {
      writes.run([&] { insert(i); });
      EXPECT_EQ(count(), 21);
    });
  }
  writers.clear();
  EXPECT_EQ(commits_, 2);
}

TEST_F(GroupCommitTest, OneThatFailsTakesBackItsOwnAndTheOthersStay) {
  GroupCommit writes(database_, hold_first(writes, 6));
  std::vector<std::jthread> writers;
  writers.emplace_back([&] { writes.run([&] { insert(0); }); });
  while (commits_ == 0) std::this_thread::yield();
  for (int i = 1; i <= 6; ++i) {
    writers.emplace_back([&, i] {
      const auto write = [&] {
        writes.run([&] {
          insert(i);
          if (i % 2 == 0) throw std::runtime_error("no");
          if (i == 3) insert(0);
        });
      };
      if (i % 2 == 0) {
        EXPECT_THROW(write(), std::runtime_error);
      } else if (i == 3) {
        EXPECT_THROW(write(), ServiceError) << "The number is there already.";
      } else {
        write();
      }
    });
  }
  writers.clear();
  EXPECT_EQ(commits_, 2);
  EXPECT_EQ(count(), 3) << "0, 1 and 5.";
}

// The verdict of a body may come from what another one wrote.
TEST_F(GroupCommitTest, WhenTheCommitFailsAllAreToldThatAndTheNextOneGoesOn) {
  GroupCommit writes(database_, hold_first(writes, 2));
  // A deferred constraint is looked at by the commit.
  database_.execute("CREATE TABLE children (number INTEGER REFERENCES numbers DEFERRABLE INITIALLY DEFERRED)");
  std::vector<std::jthread> writers;
  writers.emplace_back([&] { writes.run([&] { insert(0); }); });
  while (commits_ == 0) std::this_thread::yield();
  writers.emplace_back([&] { EXPECT_THROW(writes.run([] { throw std::runtime_error("its own"); }), ServiceError); });
  writers.emplace_back(
      [&] { EXPECT_THROW(writes.run([&] { database_.execute("INSERT INTO children VALUES (7)"); }), ServiceError); });
  writers.clear();
  writes.run([&] { insert(1); });
  EXPECT_EQ(count(), 2);
}

}  // namespace
}  // namespace cellcrush::store
