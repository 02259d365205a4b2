// Tables of pages against the records of crushes. CELLCRUSH_WRITE_PAGES=1 writes them into the pages.
#include "docs/tables/record_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>

namespace cellcrush::docs {
namespace {

/// A page, from the root of the tree, and the tables that it has.
struct TablePage {
  std::string path;
  std::function<PageTables()> tables;

  friend void PrintTo(const TablePage& page, std::ostream* out) { *out << page.path; }
};

class RecordTables : public ::testing::TestWithParam<TablePage> {};

TEST_P(RecordTables, AreThoseOfTheRecords) {
  const std::filesystem::path file = std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / GetParam().path;
  const std::string text = read_text(file);
  const FilledPage filled = fill_tables(text, GetParam().tables());
  EXPECT_TRUE(filled.findings.empty()) << to_text(filled.findings);
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) {
    std::ofstream(file) << filled.text;
  } else {
    EXPECT_EQ(text, filled.text) << "A record has changed. Write its tables into the page again: "
                                    "CELLCRUSH_WRITE_PAGES=1 build/ci/bin/docs_tables";
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, RecordTables,
                         ::testing::Values(TablePage{"tests/accuracy.md", accuracy_tables},
                                           TablePage{"tests/validation/RESULTS.md", long_crush_tables},
                                           TablePage{"core/what-is-computed.md", mesh_tables},
                                           TablePage{"tests/bench/README.md", bench_tables},
                                           TablePage{"tests/stability/README.md", stability_tables}));

TEST(PageTables, StandBetweenTheirMarks) {
  PageTable table({"name", "#number"});
  table.add_row({"one", "1"});
  table.add_row({"", "2"});
  const FilledPage filled = fill_tables("a\n<!-- table: t -->\nold\n<!-- end of table -->\nb\n", {{"t", table.text()}});
  EXPECT_EQ(
      filled.text,
      "a\n<!-- table: t -->\n\n| name | number |\n|---|---:|\n| one | 1 |\n| | 2 |\n\n<!-- end of table -->\nb\n");
  EXPECT_THAT(filled.findings, ::testing::IsEmpty());
}

TEST(PageTables, MarksThatDoNotFitAreFound) {
  EXPECT_THAT(fill_tables("<!-- table: x -->\n<!-- end of table -->\n<!-- end of table -->\n<!-- table: t -->\n",
                          {{"t", ""}, {"u", ""}})
                  .findings,
              ::testing::ElementsAre("line 1: no such table: x", "line 3: ends a table that has not begun",
                                     "the last table has no end; write <!-- end of table -->", "not in the page: u"));
}

TEST(PageNumbers, HaveTheDecimalsAsked) {
  EXPECT_EQ(fixed(1.25, 1), "1.2");
  EXPECT_EQ(fixed(-0.001, 1), "0.0");
  EXPECT_EQ(signed_percent(0.0123, 1), "+1.2 %");
  EXPECT_EQ(percent_of(0.013, 0.004, 1), "1.3 ± 0.4 %");
  EXPECT_EQ(percent(std::nan(""), 1), "");
}

}  // namespace
}  // namespace cellcrush::docs
