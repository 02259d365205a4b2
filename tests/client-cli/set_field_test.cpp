#include "case_file/set_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "command_error.h"

namespace cellcrush::client {
namespace {

std::string refusal(v1::Case scene, const std::string& assignment) {
  try {
    set_field(scene, assignment);
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::refused);
    return error.message();
  }
  return {};
}

v1::Case hexagons() {
  v1::Case scene;
  scene.mutable_lattice()->mutable_hexagon()->set_columns(74);
  return scene;
}

v1::Case frame() {
  v1::Case scene;
  scene.mutable_lattice()->mutable_frame()->add_nodes()->set_id("a");
  scene.mutable_lattice()->mutable_frame()->add_nodes()->set_id("b");
  scene.mutable_lattice()->mutable_frame()->add_watched_nodes(std::string("a"));
  return scene;
}

TEST(SetField, SetsEveryKindOfValue) {
  v1::Case scene = hexagons();
  for (const char* assignment :
       {"loading.speed_m_per_s=1e2", "lattice.hexagon.rows=21", "lattice.imperfection.seed=18446744073709551615",
        "loading.direction=y", "title=a = b", "numerics.time_step_s=-2e-7"}) {
    set_field(scene, assignment);
  }
  EXPECT_EQ(scene.loading().speed_m_per_s(), 100.0);
  EXPECT_EQ(scene.lattice().hexagon().rows(), 21);
  EXPECT_EQ(scene.lattice().hexagon().columns(), 74);
  EXPECT_EQ(scene.lattice().imperfection().seed(), 18446744073709551615ULL);
  EXPECT_EQ(scene.loading().direction(), v1::Loading::Y);
  EXPECT_EQ(scene.title(), "a = b");
  EXPECT_EQ(scene.numerics().time_step_s(), -2e-7);
}

TEST(SetField, SetsElementsOfLists) {
  v1::Case scene = frame();
  set_field(scene, "lattice.frame.nodes[1].x_mm=2.5");
  set_field(scene, "lattice.frame.watched_nodes[0]=b");
  set_field(scene, "lattice.frame.self_contact=true");
  EXPECT_EQ(scene.lattice().frame().nodes(1).x_mm(), 2.5);
  EXPECT_EQ(scene.lattice().frame().watched_nodes(0), "b");
  EXPECT_TRUE(scene.lattice().frame().self_contact());
}

TEST(SetField, NotANumberIsLeftToTheServerToRefuse) {
  v1::Case scene;
  set_field(scene, "depth_mm=nan");
  EXPECT_TRUE(std::isnan(scene.depth_mm()));
}

TEST(SetField, AnUnknownPathNamesTheNearestField) {
  EXPECT_EQ(refusal(hexagons(), "loading.sped_m_per_s=1"),
            "--set loading.sped_m_per_s: Loading has no field \"sped_m_per_s\"; did you mean \"speed_m_per_s\"?");
  EXPECT_NE(refusal(hexagons(), "xyzzy=1").find("it has: title, lattice"), std::string::npos);
}

TEST(SetField, AWrongTypeSaysWhatIsExpected) {
  EXPECT_NE(refusal(hexagons(), "lattice.hexagon.rows=2.5").find("\"2.5\" is not a 32-bit integer"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "depth_mm=thick").find("\"thick\" is not a number"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "depth_mm=").find("\"\" is not a number"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "depth_mm=4 mm").find("\"4 mm\" is not a number"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "loading.direction=Z").find("\"Z\" is not one of X, Y"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "lattice.imperfection.seed=-1").find("non-negative"), std::string::npos);
  EXPECT_NE(refusal(frame(), "lattice.frame.self_contact=yes").find("neither true nor false"), std::string::npos);
}

TEST(SetField, AGroupIsNotAValue) {
  EXPECT_NE(refusal(hexagons(), "loading=5").find("is a group; set one of its fields: direction, speed_m_per_s"),
            std::string::npos);
  EXPECT_NE(refusal(hexagons(), "depth_mm.x=5").find("is a single value"), std::string::npos);
}

TEST(SetField, AFieldOfAnotherLatticeIsRefused) {
  const std::string message = refusal(hexagons(), "lattice.square.columns=5");
  EXPECT_NE(message.find("this case has the lattice \"hexagon\""), std::string::npos) << message;
  v1::Case empty;
  set_field(empty, "lattice.square.columns=5");
  EXPECT_EQ(empty.lattice().square().columns(), 5);
}

TEST(SetField, ElementsMustBeThere) {
  EXPECT_NE(refusal(frame(), "lattice.frame.nodes[2].x_mm=1").find("has 2 elements"), std::string::npos);
  EXPECT_NE(refusal(frame(), "lattice.frame.nodes.x_mm=1").find("nodes[0]"), std::string::npos);
  EXPECT_NE(refusal(frame(), "lattice.frame.nodes[x].x_mm=1").find("nodes[0]"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "loading[0].speed_m_per_s=1").find("is not a list"), std::string::npos);
}

TEST(SetField, AnAssignmentHasAPathAndAnEqualsSign) {
  EXPECT_NE(refusal(hexagons(), "loading.speed_m_per_s").find("expected PATH=VALUE"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "=5").find("expected PATH=VALUE"), std::string::npos);
  EXPECT_NE(refusal(hexagons(), "loading..speed=5").find("has no field \"\""), std::string::npos);
}

}  // namespace
}  // namespace cellcrush::client
