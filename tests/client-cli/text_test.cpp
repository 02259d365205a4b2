#include <gtest/gtest.h>

#include "command_error.h"
#include "google/rpc/status.pb.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

TEST(NumberText, KeepsSignificantDigits) {
  EXPECT_EQ(number_text(3.41234), "3.41");
  EXPECT_EQ(percent_text(-2e-7, 2), "0.00 %");
  EXPECT_EQ(percent_text(-0.002, 2), "-0.20 %");
  EXPECT_EQ(number_text(0.08664), "0.0866");
  EXPECT_EQ(number_text(0.99961), "1.00");
  EXPECT_EQ(number_text(512.69, 4), "512.7");
  EXPECT_EQ(number_text(20504), "20504");
  EXPECT_EQ(number_text(2e-7), "2.00e-07");
  EXPECT_EQ(number_text(-0.5), "-0.500");
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "not a number");
}

TEST(NumberText, CountsDurationsAndSizes) {
  EXPECT_EQ(count_text(9642), "9642");
  EXPECT_EQ(count_text(20504), "20 504");
  EXPECT_EQ(count_text(-1234567), "-1 234 567");
  EXPECT_EQ(duration_text(0.84), "0.8 s");
  EXPECT_EQ(duration_text(9.97), "10 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(723), "12 min 03 s");
  EXPECT_EQ(duration_text(3 * 3600 + 5 * 60), "3 h 05 min");
  EXPECT_EQ(duration_text(-1), "unknown");
  EXPECT_EQ(size_text(512), "512 B");
  EXPECT_EQ(size_text(12345678), "12.3 MB");
  EXPECT_EQ(size_text(999999), "1.00 MB");
  EXPECT_EQ(percent_text(0.4731), "47.3 %");
}

TEST(Table, AlignsColumnsByCharactersAndNotBytes) {
  Table table({Table::Align::left, Table::Align::right, Table::Align::left});
  table.add({"a", "1", "mm"});
  table.add({"bé", "22.5", ""});
  EXPECT_EQ(table.text(1, 80), " a      1  mm\n bé  22.5\n");
}

TEST(Table, BreaksTextsBetweenWordsFromTheLastColumnOn) {
  Table table({Table::Align::left, Table::Align::right, Table::Align::left});
  table.add({"a case", "22.5", "the plate moves along the rows of the lattice"});
  EXPECT_EQ(table.text(0, 40),
            "a case  22.5  the plate moves along the\n"
            "              rows of the lattice\n");
}

TEST(Table, WithKeysContinuesBelowAndTakesOutWhatDoesNotVary) {
  using enum Table::Align;
  Table table({left, right, right, right}, 1);
  table.add({"job", "impact", "support", "error"});
  table.add({"", "MPa", "MPa", "%"});
  table.add({"jobs/1", "3.41", "0.44", "1"});
  table.add({"jobs/2", "3.42", "0.44", "2"});
  EXPECT_EQ(table.remove_constant_columns(1, 2), std::vector<std::string>{"support 0.44 MPa"});
  EXPECT_EQ(table.text(0, 80),
            "job     impact  error\n           MPa      %\njobs/1    3.41      1\njobs/2    3.42      2\n");
  EXPECT_EQ(table.text(0, 16),
            "job     impact\n           MPa\njobs/1    3.41\njobs/2    3.42\n\n"
            "job     error\n            %\njobs/1      1\njobs/2      2\n");
}

TEST(Table, SaysNoneWhereNoRowHasAValue) {
  using enum Table::Align;
  Table table({left, right}, 1);
  table.add({"job", "strain"});
  table.add({"", "%"});
  table.add({"jobs/1", "-"});
  table.add({"jobs/2", "-"});
  EXPECT_EQ(table.remove_constant_columns(1, 2), std::vector<std::string>{"strain none"});
}

TEST(Table, InANarrowTerminalBreaksHeadingsAndNoFigures) {
  using enum Table::Align;
  Table table({left, right, right, left});
  table.add({"fidelity", "elements per wall", "predicted time", "error"});
  table.add({"REFERENCE", "20 504", "12 min 03 s", unbreakable("11.4 % ± 2.8 %")});
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

TEST(Problems, NotesStandInTheTerminalsWidth) {
  v1::ProblemList list;
  v1::Problem& note = *list.add_problems();
  note.set_field("material.density_kg_per_m3");
  note.set_value("2.7");
  note.set_message("is far below that of any solid. Is it in g/cm^3?");
  note.set_remedy("Give kg/m^3: 2.7 g/cm^3 are 2700 kg/m^3.");
  const std::string text = notes_text(list.problems());
  EXPECT_EQ(text.find("Note: material.density_kg_per_m3 = 2.7 is far below"), 0U) << text;
  EXPECT_NE(text.find("2700 kg/m^3."), std::string::npos) << text;
}

TEST(Text, IsWrappedBetweenWordsAndLongWordsAtTheEnd) {
  EXPECT_EQ(wrapped("one two three", 9, "- ", "  "), "- one two\n  three\n");
  EXPECT_EQ(wrap_words("ab cdefghij", 4), (std::vector<std::string>{"ab", "cdef", "ghij"}));
  EXPECT_EQ(wrap_words("hexagon.wall_thickness_mm", 20), (std::vector<std::string>{"hexagon.wall_", "thickness_mm"}));
  EXPECT_EQ(wrap_words("error " + unbreakable("± 2.8"), 8), (std::vector<std::string>{"error", "± 2.8"}));
  EXPECT_EQ(wrap_words("theory (Eq. 51), 2.8 % above", 12),
            (std::vector<std::string>{"theory", "(Eq. 51),", "2.8 % above"}));
  EXPECT_EQ(wrap_words("", 4), std::vector<std::string>{""});
}

TEST(Table, CutsWideTextAndDisarmsControlCharacters) {
  EXPECT_EQ(cut("honeycomb", 20), "honeycomb");
  EXPECT_EQ(cut("a long honeycomb", 10), "a long ...");
  EXPECT_EQ(display_width(cut("ééééééééééééé", 10)), 10);
  EXPECT_EQ(printable("a\x1b[2Jb"), "a\\x1b[2Jb");
  EXPECT_EQ(printable("line\nbell\x07 del\x7f"), "line\nbell\\x07 del\\x7f");
  EXPECT_EQ(printable("\xff\xc3 caf\xc3\xa9 \xe2\x82\xac \xc2\x9b"), "\\xff\\xc3 caf\xc3\xa9 \xe2\x82\xac \\xc2\\x9b");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
}

TEST(Problems, AreReadFromTheStatusDetailsAndPrintedWithRemedies) {
  v1::ProblemList list;
  v1::Problem& first = *list.add_problems();
  first.set_field("loading.speed_m_per_s");
  first.set_value("-5");
  first.set_message("must be above 0");
  first.set_remedy("give the plate's speed, such as 100");
  v1::Problem& second = *list.add_problems();
  second.set_field("lattice");
  second.set_message("is missing");
  google::rpc::Status envelope;
  envelope.add_details()->PackFrom(list);
  const grpc::Status status(grpc::StatusCode::INVALID_ARGUMENT, "refused", envelope.SerializeAsString());
  const CommandError error = error_of(status);
  EXPECT_EQ(error.code(), ExitCode::refused);
  EXPECT_EQ(error.message(), "the case has 2 problems");
  list.mutable_problems(1)->set_field("filter");
  EXPECT_EQ(problems_error(list).message(), "the request has 2 problems");
  EXPECT_EQ(problems_text(error.problems()),
            "loading.speed_m_per_s = -5: must be above 0\n    Remedy: give the plate's speed, such as 100\nlattice: is "
            "missing\n");
}

TEST(Problems, RubbishInTheDetailsDoesNoHarm) {
  const CommandError error = error_of({grpc::StatusCode::INVALID_ARGUMENT, "bad", "\xff\xfe rubbish"});
  EXPECT_EQ(error.problems().problems_size(), 0);
  EXPECT_EQ(error.message(), "bad");
}

}  // namespace
}  // namespace cellcrush::client
