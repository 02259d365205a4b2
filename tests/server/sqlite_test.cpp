#include "store/sqlite.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <optional>

#include "error.h"
#include "server/temporary_folder.h"

namespace cellcrush::store {
namespace {

class SqliteTest : public ::testing::Test {
 protected:
  SqliteTest() { database_.execute("CREATE TABLE numbers (number INTEGER PRIMARY KEY)"); }

  [[nodiscard]] int prepared() const {
    int out = 0;
    sqlite3_stmt* statement = nullptr;
    while ((statement = sqlite3_next_stmt(database_.raw(), statement)) != nullptr) ++out;
    return out;
  }

  static constexpr const char* kInsert = "INSERT INTO numbers VALUES (?1)";

  testing::TemporaryFolder folder_;
  Database database_{folder_.path() / "numbers.sqlite"};
};

TEST_F(SqliteTest, AStatementOfTheSameTextIsPreparedOnce) {
  for (int i = 1; i <= 5; ++i) Statement(database_, kInsert).bind(1, i).run();
  EXPECT_EQ(prepared(), 1);
  {
    Statement one(database_, kInsert);
    Statement other(database_, kInsert);
    EXPECT_EQ(prepared(), 2) << "Two that live at once are two.";
  }
  for (int i = 6; i <= 9; ++i) Statement(database_, kInsert).bind(1, i).run();
  EXPECT_EQ(prepared(), 2);
}

TEST_F(SqliteTest, AStatementThatIsUsedAgainKnowsNothingOfTheTimeBefore) {
  Statement(database_, kInsert).bind(1, 7).run();
  EXPECT_THROW(Statement(database_, kInsert).bind(1, 7).run(), ServiceError);
  // Without a number SQLite takes the next one: the 7 is not bound any more.
  Statement(database_, kInsert).run();
  EXPECT_EQ(database_.last_number(), 8);
}

TEST_F(SqliteTest, AReadingThatIsLeftInTheMiddleHoldsNothingUp) {
  for (int i = 1; i <= 3; ++i) Statement(database_, kInsert).bind(1, i).run();
  constexpr const char* kSelect = "SELECT number FROM numbers ORDER BY number";
  std::optional<Statement> read(std::in_place, database_, kSelect);
  ASSERT_TRUE(read->step());
  read.reset();
  EXPECT_NO_THROW(database_.execute("DROP TABLE numbers; CREATE TABLE numbers (number INTEGER PRIMARY KEY)"));
  EXPECT_FALSE(Statement(database_, kSelect).step()) << "It begins anew, of the table that is there now.";
}

}  // namespace
}  // namespace cellcrush::store
