#include "plots/stage_panels.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <regex>
#include <utility>
#include <vector>

#include "plots/job_picture.h"
#include "programs/text_proto.h"
#include "synthetic_crush.h"
#include "terminal/case_text.h"

namespace cellcrush::client {
namespace {

LatticeStage drawn_stage(int columns, int rows, double strain, bool along_y = false) {
  return lattice_stage(testing::synthetic_stage(columns, rows, strain, along_y));
}

std::vector<LatticeStage> stages_of(int columns, int rows, bool along_y, int count) {
  std::vector<LatticeStage> stages;
  stages.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) stages.push_back(drawn_stage(columns, rows, 0.8 * i / count, along_y));
  return stages;
}

int columns_of(const StagePanels& panels) {
  int columns = 0;
  for (const Rectangle& place : panels.places) columns += place.y == panels.places.front().y ? 1 : 0;
  return columns;
}

// Undeformed ones fill rows of one, two or three; crushed ones stand beside each other where whole ones would not.
TEST(StagePanels, RowsAreFilled) {
  EXPECT_EQ(columns_of(lay_stages(stages_of(14, 21, true, 3), 0, 0, 948)), 3);
  EXPECT_EQ(columns_of(lay_stages(stages_of(18, 21, true, 3), 0, 0, 948)), 3);
  const std::vector<LatticeStage> late{drawn_stage(74, 21, 0.2), drawn_stage(74, 21, 0.4), drawn_stage(74, 21, 0.8)};
  EXPECT_EQ(columns_of(lay_stages(late, 0, 0, 948)), 1);
  const StagePanels panels = lay_stages(late, 0, 0, 948);
  EXPECT_EQ(panels.places[1].y, panels.places[2].y) << "the second and the third fit into one row";
}

// The way that the plate has travelled is not drawn; the scale is the same for all.
TEST(StagePanels, ACrushedLatticeTakesLessRoom) {
  for (const bool along_y : {false, true}) {
    const std::vector<LatticeStage> stages{drawn_stage(20, 7, 0.0, along_y), drawn_stage(20, 7, 0.6, along_y)};
    const StagePanels panels = lay_stages(stages, 0, 0, 948);
    const auto length = [&](std::size_t i) { return along_y ? panels.places[i].height : panels.places[i].width; };
    EXPECT_NEAR(length(1) / length(0), 0.4, 0.06) << "40 % are left, and the margins";
    EXPECT_NEAR(drawing_scale(panels.places[0], panels.boxes[0]), drawing_scale(panels.places[1], panels.boxes[1]),
                1e-9);
  }
}

TEST(StagePanels, StayInsideTheWidthAndDoNotOverlap) {
  for (const int count : {1, 2, 5, 6, 13, 40}) {
    for (const bool tall : {false, true}) {
      const auto panels = lay_stages(stages_of(tall ? 6 : 20, tall ? 9 : 5, tall, count), 10, 20, 500);
      ASSERT_EQ(static_cast<int>(panels.places.size()), count);
      for (std::size_t i = 0; i < panels.places.size(); ++i) {
        const Rectangle& place = panels.places[i];
        EXPECT_GT(place.width, 1.0);
        EXPECT_GT(place.height, 1.0);
        EXPECT_GE(place.x, 10.0);
        EXPECT_GE(place.y, 20.0);
        EXPECT_LE(place.x + place.width, 510.0 + 1e-9);
        EXPECT_LE(place.y + place.height, panels.bottom);
        for (std::size_t j = 0; j < i; ++j) {
          const Rectangle& other = panels.places[j];
          EXPECT_TRUE(other.x + other.width <= place.x + 1e-9 || other.y + other.height <= place.y + 1e-9);
        }
      }
    }
  }
}

TEST(JobPicture, OfAWidthInPrintFitsOnAPage) {
  std::vector<MeshFrame> frames;
  for (const double strain : {0.0, 0.2, 0.4, 0.8}) frames.push_back(testing::synthetic_stage(20, 7, strain));
  const JobHistory history{cellcrush::testing::from_text<v1::Job>("words { plates: true }"),
                           testing::synthetic_samples(100, 0.8)};
  for (const PrintSize print : {PrintSize{85.0, 8.0}, PrintSize{85.0, 9.0}, PrintSize{140.0, 7.0}, PrintSize{180.0}}) {
    for (const std::string& svg : {render_job_picture(PictureFormat::svg, history, frames, print),
                                   render_stages_picture(PictureFormat::svg, frames, {}, print)}) {
      std::smatch height;
      ASSERT_TRUE(std::regex_search(svg, height, std::regex("height=\"([0-9.]+)mm\"")));
      EXPECT_LE(std::stod(height[1]), 240.01) << print.width_mm << ' ' << print.font_pt;
    }
  }
}

TEST(RigidWalls, OneAloneCrushesAgainstNothing) {
  v1::Job job;
  job.mutable_summary()->add_rigid_walls()->set_wall("side_low");
  EXPECT_TRUE(has_support(job));
  job.mutable_summary()->add_rigid_walls()->set_wall("striker");
  EXPECT_FALSE(has_support(job));
  job.mutable_words()->set_plates(true);
  EXPECT_TRUE(has_support(job));
}

TEST(RigidWalls, AreWhereTheSamplesHaveMovedThem) {
  const auto submitted = cellcrush::testing::from_text<v1::Case>(R"(
    lattice { frame { rigid_walls { id: "top" y_mm: 40 normal_y: -2 } } }
    loading {
      rigid_walls { id: "turned" x_mm: 1 normal_x: 3 normal_y: 4 }
      rigid_walls { id: "at_edge" edge: RIGHT }
    })");
  v1::Mesh mesh;  // a bar from 0 to 8 mm
  for (const float place : {0.0F, 0.0F, 8.0F, 0.0F}) mesh.add_position_mm(place);
  for (const int node : {0, 1}) mesh.add_element_nodes(node);
  mesh.add_thickness_mm(2.0F);
  std::vector<v1::Sample> samples;
  for (const double time : {0.001, 0.003}) {
    v1::Sample& sample = samples.emplace_back();
    sample.set_time_s(time);
    sample.add_rigid_walls()->set_displacement_mm(1e4 * time);
    sample.add_rigid_walls()->set_displacement_mm(0.0);
    sample.add_rigid_walls()->set_displacement_mm(1.0);
  }
  const RigidWalls walls(submitted, samples);
  for (const auto& [time, y] : {std::pair(0.0, 40.0), {0.001, 30.0}, {0.002, 20.0}, {0.003, 10.0}, {0.004, 10.0}}) {
    const std::vector<WallFace> faces = walls.at(time, mesh);
    ASSERT_EQ(faces.size(), 3u);
    EXPECT_NEAR(faces[0].y, y, 1e-9) << time;
    EXPECT_NEAR(faces[1].normal_x, 0.6, 1e-12);
    EXPECT_EQ(faces[1].x, 1.0);
    EXPECT_EQ(faces[2].normal_x, -1.0);
    EXPECT_NEAR(faces[2].x, 9.0 - (time > 0.0009 ? 1.0 : 0.0), 1e-6);
  }
  EXPECT_TRUE(RigidWalls({}, samples).at(0.002, mesh).empty());
}

}  // namespace
}  // namespace cellcrush::client
