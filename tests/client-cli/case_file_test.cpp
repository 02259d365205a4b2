// Case files, --set and --over: what is read, and what is said of what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "case_file/case_source.h"
#include "case_file/set_field.h"
#include "case_file/typed_number.h"
#include "commands/sweep_axis.h"
#include "expect_text.h"
#include "usage/suggestion.h"

namespace cellcrush::client {

namespace {

using ::testing::HasSubstr;
using testing::refusal;

std::string text_errors(const std::string& text) {
  return refusal([&] { parse_text_case(text, "c.txtpb"); });
}

TEST(CaseFile, ReadsTextAndJson) {
  for (const v1::Case& scene :
       {parse_text_case("# a case\ntitle: \"x\"\nloading { speed_m_per_s: 1e2 direction: y }\n", "c.txtpb"),
        parse_text_case("title: \"x\" loading { speed_m_per_s: 100 direction: Y }", "c.txtpb"),
        parse_json_case(R"({"title": "x", "loading": {"speed_m_per_s": 100, "direction": "y"}})", "c.json"),
        parse_json_case(R"({"title": "x", "loading": {"speedMPerS": 100, "direction": "Y"}})", "c.json")}) {
    EXPECT_EQ(scene.title(), "x");
    EXPECT_EQ(scene.loading().speed_m_per_s(), 100.0);
    EXPECT_EQ(scene.loading().direction(), v1::Loading::Y);
  }
}

TEST(CaseFile, WhatIsWrongIsNamedWithItsPlace) {
  const std::pair<const char*, const char*> texts[] = {
      {"loading {\n  sped_m_per_s: 5\n}\nmaterail { }\n",
       "c.txtpb:2:3: Loading has no field \"sped_m_per_s\"; did you mean \"speed_m_per_s\"?"},
      {"loading {\n  sped_m_per_s: 5\n}\nmaterail { }\n",
       "c.txtpb:4:1: Case has no field \"materail\"; did you mean \"material\"?"},
      {"depth_mm: \"thick\"\n", "c.txtpb:1:11: "},
      {"lattice { depth_mm: 1 }",
       "Lattice has no field \"depth_mm\"; it is a field of the case itself: write it outside of all braces"},
      {"lattice { frame { nodes { name: 'a' } } }", "Node has no field \"name\"; it has: id, x_mm"},
      {"loading { direction: Z }", "c.txtpb:1:22: direction: \"Z\" is not one of X, Y"},
      {"lattice {\n  hexagon {\n    columns: 74\n", "c.txtpb:4:1: the file ends too early"},
      {"lattice {\n  hexagon {\n    columns:", "c.txtpb:3:13: "},
      {"\xff\x13PNG\x1a", "c.txtpb:1:"}};
  for (const auto& [text, error] : texts) EXPECT_THAT(text_errors(text), HasSubstr(error)) << text;
  const std::pair<const char*, const char*> objects[] = {
      {R"({"loading": {"speed_m_per_s": "fast"}})", "c.json: loading.speed_m_per_s: expected a number, not fast"},
      {R"({"loading": {"direction": "Z"}})", "c.json: loading.direction: \"Z\" is not one of X, Y"},
      {R"({"lattice": {"frame": {"nodes": [{"id": "a"}, {"idd": "b"}]}}})",
       "c.json: lattice.frame.nodes[1].idd: Node has no field \"idd\"; did you mean \"id\"?"},
      {R"({"loadng": {}})", "c.json: loadng: Case has no field \"loadng\"; did you mean \"loading\"?"},
      {R"({"lattice": {"hexagon": {}, "square": {}}})", "c.json: lattice: "},
      {R"({"loading": )", "c.json: "}};
  for (const auto& [text, error] : objects) {
    EXPECT_THAT(refusal([&, json = text] { parse_json_case(json, "c.json"); }), HasSubstr(error)) << text;
  }
}

TEST(CaseFile, PutsManyValuesIntoCapitalsInOnePass) {
  std::string text = "# direction: y\ntitle: \"component: component_y\"\nlattice { frame {\n";
  constexpr int kLoads = 40'000;
  for (int i = 0; i < kLoads; ++i) text += "loads { node: \"a\" component: component_y }\n";
  const v1::Case scene = parse_text_case(text + "} }\nloading { direction: y }", "c.txtpb");
  EXPECT_EQ(scene.title(), "component: component_y");
  EXPECT_EQ(scene.loading().direction(), v1::Loading::Y);
  ASSERT_EQ(scene.lattice().frame().loads_size(), kLoads);
  EXPECT_EQ(scene.lattice().frame().loads(kLoads - 1).component(), v1::Frame::COMPONENT_Y);
}

TEST(CaseFile, NamesTheFirstErrorsAndHowManyMoreThereAre) {
  std::string text;
  for (int i = 0; i < 70; ++i) text += "materail { }\n";
  const std::string errors = text_errors(text);
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 51);
  EXPECT_THAT(errors, HasSubstr("\nand 20 more"));
}

TEST(Suggestion, FindsTheNearestNameOrNone) {
  const std::vector<std::string> names = {"columns", "rows", "side_mm", "wall_thickness_mm"};
  EXPECT_EQ(find_nearest("colums", names), "columns");
  EXPECT_EQ(find_nearest("row", names), "rows");
  EXPECT_EQ(find_nearest("sied_mm", names), "side_mm");
  EXPECT_EQ(find_nearest("wall_thickness", names), "wall_thickness_mm");
  EXPECT_EQ(find_nearest("temperature", names), "");
}

v1::Case with(const std::string& scene, const std::vector<const char*>& assignments) {
  v1::Case out = parse_text_case(scene, "c.txtpb");
  for (const char* assignment : assignments) set_field(out, assignment);
  return out;
}

constexpr const char* kOneHexagonLattice = "lattice { hexagon { columns: 74 } }";
constexpr const char* kTwoNodes = "lattice { frame { nodes { id: \"a\" } nodes { id: \"b\" } watched_nodes: \"a\" } }";

TEST(SetField, SetsEveryKindOfValueAndElementsOfLists) {
  const v1::Case scene =
      with(kOneHexagonLattice,
           {"loading.speed_m_per_s=1e2", "lattice.hexagon.rows=21", "title=a = b", "loading.direction=y",
            "lattice.imperfection.seed=18446744073709551615", "numerics.time_step_s=-2e-7", "depth_mm=3,5"});
  EXPECT_EQ(scene.loading().speed_m_per_s(), 100.0);
  EXPECT_EQ(scene.lattice().hexagon().rows(), 21);
  EXPECT_EQ(scene.lattice().hexagon().columns(), 74);
  EXPECT_EQ(scene.lattice().imperfection().seed(), 18446744073709551615ULL);
  EXPECT_EQ(scene.loading().direction(), v1::Loading::Y);
  EXPECT_EQ(scene.title(), "a = b");
  EXPECT_EQ(scene.numerics().time_step_s(), -2e-7);
  EXPECT_EQ(scene.depth_mm(), 3.5);
  const v1::Case frame = with(kTwoNodes, {"lattice.frame.nodes[1].x_mm=2.5", "lattice.frame.watched_nodes[0]=b",
                                          "lattice.frame.self_contact=true"});
  EXPECT_EQ(frame.lattice().frame().nodes(1).x_mm(), 2.5);
  EXPECT_EQ(frame.lattice().frame().watched_nodes(0), "b");
  EXPECT_TRUE(frame.lattice().frame().self_contact());
  EXPECT_EQ(with("", {"lattice.square.columns=5"}).lattice().square().columns(), 5);
}

TEST(SetField, SaysWhatIsWrongAndWhatIsExpected) {
  const std::array<const char*, 3> refused[] = {
      {kOneHexagonLattice, "loading.sped_m_per_s=1",
       "--set loading.sped_m_per_s: Loading has no field \"sped_m_per_s\"; did you mean \"speed_m_per_s\"?"},
      {kOneHexagonLattice, "xyzzy=1", "it has: title, lattice"},
      {kOneHexagonLattice, "lattice.hexagon.rows=2.5", "\"2.5\" is not a whole number"},
      {kOneHexagonLattice, "depth_mm=thick", "\"thick\" is not a number"},
      {kOneHexagonLattice, "depth_mm=", "\"\" is not a number"},
      {kOneHexagonLattice, "depth_mm=4 mm", "\"4 mm\" is not a number"},
      {kOneHexagonLattice, "loading.direction=Z", "\"Z\" is not one of X, Y"},
      {kOneHexagonLattice, "lattice.imperfection.seed=-1", "non-negative"},
      {kOneHexagonLattice, "material.yield_stress_mpa=1,200", "\"1,200\" could be 1.2 or 1200: write 1.2 or 1200"},
      {kTwoNodes, "lattice.frame.self_contact=yes", "neither true nor false"},
      {kOneHexagonLattice, "loading=5", "is a group; set one of its fields: direction, speed_m_per_s"},
      {kOneHexagonLattice, "depth_mm.x=5", "is a single value"},
      {kOneHexagonLattice, "lattice.square.columns=5", "this case has the lattice \"hexagon\""},
      {kTwoNodes, "lattice.frame.nodes[2].x_mm=1", "has 2 elements"},
      {kTwoNodes, "lattice.frame.nodes.x_mm=1", "nodes[0]"},
      {kTwoNodes, "lattice.frame.nodes[x].x_mm=1", "nodes[0]"},
      {kOneHexagonLattice, "loading[0].speed_m_per_s=1", "is not a list"},
      {kOneHexagonLattice, "loading.speed_m_per_s", "expected PATH=VALUE"},
      {kOneHexagonLattice, "=5", "expected PATH=VALUE"},
      {kOneHexagonLattice, "loading..speed=5", "has no field \"\""}};
  for (const auto& [scene, assignment, answer] : refused) {
    EXPECT_THAT(refusal([&, text = scene, set = assignment] { with(text, {set}); }), HasSubstr(answer)) << assignment;
  }
}

// The page reads the same table (server/page/test/form.test.mjs).
TEST(TypedNumber, IsReadByTheTableThatThePageReadsToo) {
  std::ifstream table(CELLCRUSH_TYPED_NUMBERS);
  std::string line;
  std::getline(table, line);
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    std::istringstream row(line);
    std::string kind, text, plain, problem;
    for (std::string* cell : {&kind, &text, &plain, &problem}) std::getline(row, *cell, ';');
    const TypedNumber read = kind == "whole" ? read_whole(text) : read_real(text);
    EXPECT_EQ(read.plain, plain) << line;
    EXPECT_EQ(read.problem, problem) << line;
  }
  EXPECT_GT(rows, 30);
}

TEST(SweepAxis, IsAListARangeOrSeeds) {
  const std::pair<const char*, const char*> axes[] = {
      {"depth_mm=50,1e2,-3", "list { values: 50 values: 100 values: -3 }"},
      {"depth_mm=10:200:8", "linear { first: 10 last: 200 count: 8 }"},
      {"depth_mm=0.1:10:3:log", "logarithmic { first: 0.1 last: 10 count: 3 }"},
      {"depth_mm=seeds:20", "seed_count: 20"}};
  v1::Sweep sweep;
  for (const auto& [text, shown] : axes) {
    *sweep.add_axes() = parse_axis(text);
    EXPECT_EQ(parse_axis(text).ShortDebugString(), std::string("field: \"depth_mm\" ") + shown);
  }
  EXPECT_EQ(count_points(sweep), 3.0 * 8.0 * 3.0 * 20.0);
  const std::pair<const char*, const char*> refused[] = {{"depth_mm", "FIRST:LAST:COUNT"},
                                                         {"=1", "FIRST:LAST:COUNT"},
                                                         {"depth_mm=1:2", "FIRST:LAST:COUNT"},
                                                         {"depth_mm=1:2:3:4", "FIRST:LAST:COUNT"},
                                                         {"depth_mm=1:2:3:log:5", "FIRST:LAST:COUNT"},
                                                         {"depth_mm=", "\"\" is not a number"},
                                                         {"depth_mm=1,,2", "\"\" is not a number"},
                                                         {"depth_mm=1:2:2.5", "\"2.5\" is not a whole number"},
                                                         {"depth_mm=seeds:x", "\"x\" is not a whole number"},
                                                         {"depth_mm=seeds:99999999999", "is too large"}};
  for (const auto& [text, answer] : refused)
    EXPECT_THAT(refusal([axis = text] { parse_axis(axis); }), HasSubstr(answer)) << text;
}

}  // namespace

}  // namespace cellcrush::client
