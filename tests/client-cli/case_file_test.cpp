#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "case_file/json_case.h"
#include "case_file/suggestion.h"
#include "case_file/text_case.h"
#include "command_error.h"

namespace cellcrush::client {
namespace {

std::string text_errors(const std::string& text) {
  try {
    parse_text_case(text, "c.txtpb");
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::refused);
    return error.message();
  }
  return {};
}

std::string json_errors(const std::string& text) {
  try {
    parse_json_case(text, "c.json");
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::refused);
    return error.message();
  }
  return {};
}

TEST(TextCase, ReadsFieldsAndComments) {
  const v1::Case scene =
      parse_text_case("# a case\ntitle: \"x\"\nloading { speed_m_per_s: 1e2 direction: Y }\n", "c.txtpb");
  EXPECT_EQ(scene.title(), "x");
  EXPECT_EQ(scene.loading().speed_m_per_s(), 100.0);
  EXPECT_EQ(scene.loading().direction(), v1::Loading::Y);
}

TEST(TextCase, NamesEveryMisspeltFieldWithLineAndColumn) {
  const std::string errors = text_errors("loading {\n  sped_m_per_s: 5\n}\nmaterail { }\n");
  EXPECT_NE(errors.find("c.txtpb:2:3: Loading has no field \"sped_m_per_s\"; did you mean \"speed_m_per_s\"?"),
            std::string::npos)
      << errors;
  EXPECT_NE(errors.find("c.txtpb:4:1: Case has no field \"materail\"; did you mean \"material\"?"), std::string::npos)
      << errors;
}

TEST(TextCase, NamesTheTypeThatWasExpected) {
  EXPECT_NE(text_errors("depth_mm: \"thick\"\n").find("c.txtpb:1:11: "), std::string::npos);
  EXPECT_EQ(parse_text_case("loading { direction: y } numerics { fidelity: draft }", "c.txtpb").DebugString(),
            parse_text_case("loading { direction: Y } numerics { fidelity: DRAFT }", "c.txtpb").DebugString());
  EXPECT_NE(text_errors("loading { direction: Z }").find("\"Z\" is not one of X, Y"), std::string::npos);
  EXPECT_NE(text_errors("loading { direction: Z }").find("c.txtpb:1:22: direction: "), std::string::npos)
      << text_errors("loading { direction: Z }");
}

TEST(TextCase, PutsManyValuesIntoCapitalsInOnePass) {
  std::string text = "# direction: y\ntitle: \"component: component_y\"\nlattice { frame {\n";
  constexpr int kLoads = 20'000;
  for (int i = 0; i < kLoads; ++i) text += "loads { node: \"a\" component: component_y }\n";
  const auto begin = std::chrono::steady_clock::now();
  const v1::Case scene = parse_text_case(text + "} }\nloading { direction: y }", "c.txtpb");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_EQ(scene.title(), "component: component_y");
  EXPECT_EQ(scene.loading().direction(), v1::Loading::Y);
  ASSERT_EQ(scene.lattice().frame().loads_size(), kLoads);
  EXPECT_EQ(scene.lattice().frame().loads(kLoads - 1).component(), v1::Frame::COMPONENT_Y);
}

TEST(TextCase, NamesTheFirstErrorsAndHowManyMoreThereAre) {
  std::string text;
  for (int i = 0; i < 70; ++i) text += "materail { }\n";
  const std::string errors = text_errors(text);
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 51);
  EXPECT_NE(errors.find("\nand 20 more"), std::string::npos) << errors;
}

TEST(TextCase, ATruncatedFileIsAnErrorAtItsEnd) {
  EXPECT_NE(text_errors("lattice {\n  hexagon {\n    columns: 74\n").find("c.txtpb:4:1: the file ends too early"),
            std::string::npos)
      << text_errors("lattice {\n  hexagon {\n    columns: 74\n");
  EXPECT_NE(text_errors("lattice {\n  hexagon {\n    columns:").find("c.txtpb:3:13: "), std::string::npos);
}

TEST(TextCase, BinaryRubbishIsAnError) { EXPECT_FALSE(text_errors(std::string("\x00\xff\x13PNG\x1a", 7)).empty()); }

TEST(JsonCase, ReadsProtoNamesAndCamelCase) {
  EXPECT_EQ(parse_json_case(R"({"loading": {"speed_m_per_s": 5}})", "c.json").loading().speed_m_per_s(), 5.0);
  EXPECT_EQ(parse_json_case(R"({"loading": {"speedMPerS": 5}})", "c.json").loading().speed_m_per_s(), 5.0);
}

TEST(JsonCase, NamesTheFieldsPath) {
  EXPECT_NE(json_errors(R"({"loading": {"speed_m_per_s": "fast"}})")
                .find("c.json: loading.speed_m_per_s: expected a number, not fast"),
            std::string::npos);
  EXPECT_EQ(parse_json_case(R"({"loading": {"direction": "y"}})", "c.json").loading().direction(), v1::Loading::Y);
  EXPECT_NE(
      json_errors(R"({"loading": {"direction": "Z"}})").find("c.json: loading.direction: \"Z\" is not one of X, Y"),
      std::string::npos);
  EXPECT_NE(json_errors(R"({"lattice": {"frame": {"nodes": [{"id": "a"}, {"idd": "b"}]}}})")
                .find("c.json: lattice.frame.nodes[1].idd: Node has no field \"idd\"; did you mean \"id\"?"),
            std::string::npos);
  EXPECT_NE(
      json_errors(R"({"loadng": {}})").find("c.json: loadng: Case has no field \"loadng\"; did you mean \"loading\"?"),
      std::string::npos);
}

TEST(JsonCase, TwoLatticesAreAnError) {
  EXPECT_NE(json_errors(R"({"lattice": {"hexagon": {}, "square": {}}})").find("c.json: lattice: "), std::string::npos);
}

TEST(JsonCase, ATruncatedFileIsAnError) {
  EXPECT_NE(json_errors(R"({"loading": )").find("c.json: "), std::string::npos);
}

TEST(Suggestion, FindsTheNearestNameOrNone) {
  const std::vector<std::string> names = {"columns", "rows", "side_mm", "wall_thickness_mm"};
  EXPECT_EQ(find_nearest("colums", names), "columns");
  EXPECT_EQ(find_nearest("row", names), "rows");
  EXPECT_EQ(find_nearest("sied_mm", names), "side_mm");
  EXPECT_EQ(find_nearest("wall_thickness", names), "wall_thickness_mm");
  EXPECT_EQ(find_nearest("temperature", names), "");
}

}  // namespace
}  // namespace cellcrush::client
