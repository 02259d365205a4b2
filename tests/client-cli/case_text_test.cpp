#include "terminal/case_text.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "chart/display_text.h"
#include "terminal/fidelity_text.h"
#include "terminal/job_text.h"

namespace cellcrush::client {
namespace {

v1::Case parse(const char* text) {
  v1::Case scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene));
  return scene;
}

constexpr const char* kFrame = R"(
  lattice { frame {
    nodes { id: "wall" x_mm: 0 y_mm: 0 } nodes { id: "elbow" x_mm: 0 y_mm: 50 attached_mass_g: 3 }
    nodes { id: "tip" x_mm: 50 y_mm: 50 }
    beams { start: "wall" end: "elbow" thickness_mm: 1 } beams { start: "elbow" end: "tip" thickness_mm: 0.5 }
    supports { node: "wall" fix_x: true fix_y: true fix_rotation: true }
    loads { node: "tip" component: COMPONENT_Y force_n_or_n_mm { points { time_s: 0 value: -1 } } }
    motions { node: "elbow" component: COMPONENT_ROTATION }
    initial_velocities { node: "tip" x_m_per_s: 2 }
    gravity_y_m_per_s2: -9.81
    watched_nodes: "tip" watched_nodes: "elbow"
    end_time_s: 0.02
  } }
  depth_mm: 5)";

void expect_parts(const std::string& text, const std::vector<const char*>& parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(CaseText, AFrameIsDescribedALineAPart) {
  const v1::Case scene = parse(kFrame);
  EXPECT_EQ(scene_text(scene), "frame of 3 nodes and 2 beams, loaded for 0.02 s");
  expect_parts(description_text(scene),
               {"beams                  2, 0.5 to 1 mm thick\n", "supports               wall (x y rotation)\n",
                "attached masses        on 1 node\n", "forces and moments     tip (y)\n",
                "prescribed motion      elbow (rotation)\n", "initial velocities     tip\n", "-9.81 m/s2 along y",
                "contact between beams  ignored\n", "watched nodes          tip, elbow\n",
                "end time               0.02 s\n", "depth                  5 mm\n"});
}

TEST(CaseText, LongListsAreCutAndSayHowMuchIsLeftOut) {
  const v1::Case scene = parse(R"(lattice { frame {
    watched_nodes: ["n0", "n1", "n2", "n3", "n4", "n5", "n6", "n7", "n8"]
  } })");
  expect_parts(description_text(scene), {"n0, n1, n2, n3, n4, n5 and 3 more\n", "supports               none\n"});
}

TEST(CaseText, RegularLatticesAreDescribed) {
  expect_parts(description_text(parse("lattice { square { columns: 20 rows: 12 side_mm: 5 wall_thickness_mm: 0.2 } }")),
               {"squares  20 x 12 cells\n", "walls    5 mm long, 0.2 mm thick\n"});
  expect_parts(description_text(parse("lattice { triangle { columns: 8 rows: 9 side_mm: 5 wall_thickness_mm: 0.2 } "
                                      "imperfection { amplitude_mm: 0.01 seed: 4 } }")),
               {"triangles     8 x 9 cells\n", "imperfection  joints displaced by up to 0.01 mm, seed 4\n"});
  expect_parts(description_text(parse("lattice { triangle { columns: 8 rows: 9 side_mm: 5 wall_thickness_mm: 0.2 } "
                                      "imperfection { amplitude_mm: 0.01 bow_mm: 0.02 seed: 4 } }")),
               {"joints displaced by up to 0.01 mm, walls bowed by up to 0.02 mm,"});
  expect_parts(
      description_text(parse("lattice { hexagon { columns: 8 rows: 9 side_mm: 5 wall_thickness_mm: 0.2 "
                             "vertical_wall_thickness_mm: 0.4 } inclusions { rows: 3 rows: 6 thickness_factor: 4 } } "
                             "contact { friction: 0.3 } material { youngs_modulus_mpa: 68000 yield_stress_mpa: 130 "
                             "hardening_modulus_mpa: 680 isotropic_fraction: 1 density_kg_per_m3: 2700 }"),
                       120),
      {"5 mm long, 0.2 mm thick; along y 0.4 mm\n", "stiff cells in rows 3, 6, walls 4 times as thick, rigid\n",
       "friction between walls  0.3\n",
       "E 68000 MPa, yield 130 MPa, hardening 680 MPa (100 % isotropic), 2700 kg/m3\n"});
  EXPECT_EQ(description_text(v1::Case()), "");
}

TEST(CaseText, MeasuresAreRoundedForReading) {
  expect_parts(description_text(parse("lattice { triangle { columns: 74 rows: 21 side_mm: 6.918918918918919 "
                                      "wall_thickness_mm: 0.20500756756756758 } }")),
               {"6.91892 mm long, 0.205008 mm thick\n"});
}

TEST(CaseText, TheCheckOfAFrameLeavesOutWhatOnlyACrushHas) {
  v1::CheckCaseResponse check;
  *check.mutable_completed_case() = parse(kFrame);
  check.set_particle_count(21);
  check.set_mass_g(1.25);
  const std::string frame = check_text(check, 120);
  expect_parts(frame, {"frame of 3 nodes and 2 beams", "supports", "particles", "mass of the beams"});
  EXPECT_EQ(frame.find("relative density"), std::string::npos) << frame;
  EXPECT_EQ(frame.find("(transverse)"), std::string::npos) << frame;
  *check.mutable_completed_case() = parse("lattice { square { columns: 20 rows: 12 } }");
  expect_parts(check_text(check, 120), {"squares, 20 x 12 cells", "relative density", "width (transverse)"});
}

TEST(FidelityText, ATimeAndAnErrorAFidelity) {
  v1::CheckCaseResponse check;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(R"(
    fidelities { fidelity: DRAFT elements_per_wall: 1 predicted_seconds: 12
      errors { measure: "plateau of Type I" error_relative: 0.21 uncertainty_relative: 0.02 scatter_relative: 0.03 } }
    fidelities { fidelity: STANDARD elements_per_wall: 2 predicted_seconds: 130
      errors { measure: "plateau of Type I" error_relative: 0.013 uncertainty_relative: 0.025 scatter_relative: 0.04 }
    })",
                                                            &check));
  const std::string text = fidelity_text(check, 120);
  expect_parts(text, {"DRAFT", "12 s", "21.0 % ± 2.0 %", "plateau of Type I", "Single DRAFT runs"});
  expect_parts(text, {"STANDARD", "2 min 10 s", "1.3 % ± 2.5 %"});
  expect_parts(check_text(check, 120), {text.c_str()});
}

TEST(FidelityText, KeepsFiguresAndTheirPercentSignsTogether) {
  v1::CheckCaseResponse check;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(R"(
    fidelities { fidelity: DRAFT elements_per_wall: 1 predicted_seconds: 1200
      errors { measure: "support plateau, Type I, 100 m/s" error_relative: 0.114 uncertainty_relative: 0.028 }
      errors { measure: "limit stress, Example 1, 1 m/s" error_relative: 0.02 uncertainty_relative: 0.002 } }
    fidelities { fidelity: REFERENCE elements_per_wall: 8 predicted_seconds: 99999
      errors { measure: "support plateau, Type I, 100 m/s" uncertainty_relative: 0.009 }
      errors { measure: "limit stress, Example 1, 1 m/s" uncertainty_relative: 0.002 } })",
                                                            &check));
  for (const int width : {120, 80, 60, 40}) {
    const std::string text = fidelity_text(check, width);
    expect_parts(text, {"20 min 00 s", "27 h 46 min", "11.4 %", "± 2.8 %", "± 0.2 %", "± 0.9 %"});
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(display_width(line), width) << line;
  }
}

TEST(FidelityText, WhatTheCaseGivesOtherwiseHasNoKnownError) {
  v1::CheckCaseResponse check;
  EXPECT_EQ(fidelity_text(check, 120), "");
  for (const auto fidelity : {v1::Numerics::DRAFT, v1::Numerics::REFERENCE}) {
    auto& forecast = *check.add_fidelities();
    forecast.set_fidelity(fidelity);
    forecast.set_elements_per_wall(check.fidelities_size());
    forecast.add_given_fields("section.depth_rule");
  }
  const std::string text = fidelity_text(check, 120);
  expect_parts(text, {"REFERENCE", "not known", "differs from every measured preset in section.depth_rule."});
  EXPECT_EQ(text.find("scatters"), std::string::npos) << text;
}

TEST(FidelityText, WhereTheCaseLeavesNothingToFillInOneSentenceSaysSo) {
  v1::CheckCaseResponse check;
  for (const auto fidelity : {v1::Numerics::DRAFT, v1::Numerics::REFERENCE}) {
    auto& forecast = *check.add_fidelities();
    forecast.set_fidelity(fidelity);
    forecast.set_elements_per_wall(10);
  }
  const std::string text = fidelity_text(check, 120);
  expect_parts(
      text, {"changes nothing", "sets elements_per_wall", "mesh error is not", "`cellcrush converge` estimates it."});
  EXPECT_EQ(text.find("REFERENCE"), std::string::npos) << text;
}

TEST(JobText, AFramesSummaryHasNoPlateau) {
  v1::Job job;
  job.set_name("jobs/1");
  job.set_state(v1::Job::SUCCEEDED);
  *job.mutable_case_() = parse(kFrame);
  job.mutable_summary()->set_energy_error_relative(0.001);
  const std::string text = description_text(job);
  expect_parts(text, {"energy ledger error", "0.10 %", "watched nodes"});
  EXPECT_EQ(text.find("plateau"), std::string::npos) << text;
}

}  // namespace
}  // namespace cellcrush::client
