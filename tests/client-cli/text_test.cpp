#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

TEST(NumberText, IsWrittenForReading) {
  const std::pair<std::string, const char*> texts[] = {
      {number_text(3.41234), "3.41"},
      {number_text(0.08664), "0.0866"},
      {number_text(0.99961), "1.00"},
      {number_text(512.69, 4), "512.7"},
      {number_text(20504), "20504"},
      {number_text(2e-7), "2.00e-07"},
      {number_text(-0.5), "-0.500"},
      {number_text(0.0), "0"},
      {number_text(std::numeric_limits<double>::quiet_NaN()), "not a number"},
      {percent_text(0.4731), "47.3 %"},
      {percent_text(-2e-7, 2), "0.00 %"},
      {percent_text(-0.002, 2), "-0.20 %"},
      {count_text(9642), "9642"},
      {count_text(20504), "20 504"},
      {count_text(-1234567), "-1 234 567"},
      {duration_text(0.84), "0.8 s"},
      {duration_text(9.97), "10 s"},
      {duration_text(59.6), "1 min 00 s"},
      {duration_text(723), "12 min 03 s"},
      {duration_text(3 * 3600 + 5 * 60), "3 h 05 min"},
      {duration_text(-1), "unknown"},
      {size_text(512), "512 B"},
      {size_text(12345678), "12.3 MB"},
      {size_text(999999), "1.00 MB"}};
  for (const auto& [text, expected] : texts) EXPECT_EQ(text, expected);
}

using enum Table::Align;

Table table_of(std::vector<Table::Align> columns, const std::vector<std::vector<std::string>>& rows,
               std::size_t keys = 0) {
  Table table(std::move(columns), keys);
  for (const auto& row : rows) table.add(row);
  return table;
}

TEST(Table, AlignsColumnsByCharactersAndNotBytes) {
  const Table table = table_of({left, right, left}, {{"a", "1", "mm"}, {"bé", "22.5", ""}});
  EXPECT_EQ(table.text(1, 80), " a      1  mm\n bé  22.5\n");
}

TEST(Table, BreaksTextsBetweenWordsFromTheLastColumnOn) {
  const Table table =
      table_of({left, right, left}, {{"a case", "22.5", "the plate moves along the rows of the lattice"}});
  EXPECT_EQ(table.text(0, 40),
            "a case  22.5  the plate moves along the\n"
            "              rows of the lattice\n");
}

TEST(Table, WithKeysContinuesBelowAndTakesOutWhatDoesNotVary) {
  Table table = table_of({left, right, right, right},
                         {{"job", "impact", "support", "error"},
                          {"", "MPa", "MPa", "%"},
                          {"jobs/1", "3.41", "0.44", "1"},
                          {"jobs/2", "3.42", "0.44", "2"}},
                         1);
  EXPECT_EQ(table.remove_constant_columns(1, 2), std::vector<std::string>{"support 0.44 MPa"});
  EXPECT_EQ(table.text(0, 80),
            "job     impact  error\n           MPa      %\njobs/1    3.41      1\njobs/2    3.42      2\n");
  EXPECT_EQ(table.text(0, 16),
            "job     impact\n           MPa\njobs/1    3.41\njobs/2    3.42\n\n"
            "job     error\n            %\njobs/1      1\njobs/2      2\n");
}

TEST(Table, SaysNoneWhereNoRowHasAValue) {
  Table table = table_of({left, right}, {{"job", "strain"}, {"", "%"}, {"jobs/1", "-"}, {"jobs/2", "-"}}, 1);
  EXPECT_EQ(table.remove_constant_columns(1, 2), std::vector<std::string>{"strain none"});
}

TEST(Table, InANarrowTerminalBreaksHeadingsAndNoFigures) {
  const Table table =
      table_of({left, right, right, left}, {{"fidelity", "elements per wall", "predicted time", "error"},
                                            {"REFERENCE", "20 504", "12 min 03 s", unbreakable("11.4 % ± 2.8 %")}});
  EXPECT_EQ(table.text(0, 50),
            "fidelity     elements    predicted  error\n"
            "             per wall         time\n"
            "REFERENCE      20 504  12 min 03 s  11.4 % ± 2.8 %\n");
  EXPECT_EQ(table.text(0, 34),
            "fidelity   elements    predicted\n"
            "           per wall         time\n"
            "REFERENCE    20 504  12 min 03 s\n\n"
            "fidelity   error\n"
            "REFERENCE  11.4 % ± 2.8 %\n");
}

TEST(Text, IsWrappedBetweenWordsAndLongWordsAtTheEnd) {
  EXPECT_EQ(wrapped("one two three", 9, "- ", "  "), "- one two\n  three\n");
  EXPECT_EQ(wrap_words("ab cdefghij", 4), (std::vector<std::string>{"ab", "cdef", "ghij"}));
  EXPECT_EQ(wrap_words("hexagon.wall_thickness_mm", 20), (std::vector<std::string>{"hexagon.wall_", "thickness_mm"}));
  EXPECT_EQ(wrap_words("error " + unbreakable("± 2.8"), 8), (std::vector<std::string>{"error", "± 2.8"}));
  EXPECT_EQ(wrap_words("theory (Eq. 51), 2.8 % above", 12),
            (std::vector<std::string>{"theory", "(Eq. 51),", "2.8 % above"}));
  EXPECT_EQ(wrap_words("", 4), std::vector<std::string>{""});
  EXPECT_EQ(wrap_text("one\n\ntwo three", 8), "one\n\ntwo\nthree");
}

TEST(Table, CutsWideTextAndDisarmsControlCharacters) {
  EXPECT_EQ(cut("honeycomb", 20), "honeycomb");
  EXPECT_EQ(cut("a long honeycomb", 10), "a long ...");
  EXPECT_EQ(display_width(cut("ééééééééééééé", 10)), 10);
  EXPECT_EQ(printable("a\x1b[2Jb"), "a\\x1b[2Jb");
  EXPECT_EQ(printable("line\nbell\x07 del\x7f"), "line\nbell\\x07 del\\x7f");
  EXPECT_EQ(printable("\xff\xc3 caf\xc3\xa9 \xe2\x82\xac \xc2\x9b"), "\\xff\\xc3 caf\xc3\xa9 \xe2\x82\xac \\xc2\\x9b");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
  EXPECT_EQ(printable("\u202e\u2069\u061c\u200e \u05d0"),
            "\\xe2\\x80\\xae\\xe2\\x81\\xa9\\xd8\\x9c\\xe2\\x80\\x8e \u05d0");
}

}  // namespace
}  // namespace cellcrush::client
