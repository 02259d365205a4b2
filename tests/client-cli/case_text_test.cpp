#include "terminal/case_text.h"

#include <gtest/gtest.h>

#include "expect_text.h"
#include "programs/text_proto.h"
#include "terminal/job_text.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using testing::expect_no_wider;
using testing::expect_parts_in;

TEST(CaseText, PrintsTheWordsOfTheServer) {
  v1::CaseWords words;
  EXPECT_EQ(scene_text(words), "");
  EXPECT_EQ(facts_text(words), "");
  words.set_lattice("squares, 20 x 12 cells");
  EXPECT_EQ(scene_text(words), "squares, 20 x 12 cells");
  words.set_loading("crushed along Y at 1 m/s");
  EXPECT_EQ(scene_text(words), "squares, 20 x 12 cells, crushed along Y at 1 m/s");
  for (const auto& [heading, text] : {std::pair("walls", "5 mm long"), {"material", "E 68000 MPa"}}) {
    words.add_facts()->set_heading(heading);
    words.mutable_facts()->rbegin()->set_text(text);
  }
  EXPECT_EQ(facts_text(words), "  walls     5 mm long\n  material  E 68000 MPa\n");
}

TEST(CaseText, TheCheckOfAFrameLeavesOutWhatOnlyACrushHas) {
  auto check = from_text<v1::CheckCaseResponse>(R"(
    completed_case { lattice { frame {} } } particle_count: 21 mass_g: 1.25
    words { lattice: "frame of 3 nodes and 2 beams" facts { heading: "supports" } })");
  const std::string frame = check_text(check, 120);
  expect_parts_in(frame, {"frame of 3 nodes and 2 beams", "supports", "particles", "mass of the beams"});
  EXPECT_EQ(frame.find("relative density"), std::string::npos) << frame;
  EXPECT_EQ(frame.find("(transverse)"), std::string::npos) << frame;
  check.mutable_words()->set_plates(true);
  expect_parts_in(check_text(check, 120), {"relative density", "width (transverse)"});
}

TEST(FidelityText, ATimeAndAnErrorAFidelity) {
  const auto check = from_text<v1::CheckCaseResponse>(R"(
    fidelities { fidelity: DRAFT elements_per_wall: 1 predicted_seconds: 12
      errors { measure: "plateau of Type I" error_relative: 0.21 uncertainty_relative: 0.02 scatter_relative: 0.03 } }
    fidelities { fidelity: STANDARD elements_per_wall: 2 predicted_seconds: 130
      errors { measure: "plateau of Type I" error_relative: 0.013 uncertainty_relative: 0.025 scatter_relative: 0.04 }
    })");
  const std::string text = fidelity_text(check, 120);
  expect_parts_in(text, {"DRAFT", "12 s", "21.0 % ± 2.0 %", "plateau of Type I", "Single DRAFT runs"});
  expect_parts_in(text, {"STANDARD", "2 min 10 s", "1.3 % ± 2.5 %"});
  expect_parts_in(check_text(check, 120), {text});
}

TEST(FidelityText, KeepsFiguresAndTheirPercentSignsTogether) {
  const auto check = from_text<v1::CheckCaseResponse>(R"(
    fidelities { fidelity: DRAFT elements_per_wall: 1 predicted_seconds: 1200
      errors { measure: "support plateau, Type I, 100 m/s" error_relative: 0.114 uncertainty_relative: 0.028 }
      errors { measure: "limit stress, Example 1, 1 m/s" error_relative: 0.02 uncertainty_relative: 0.002 } }
    fidelities { fidelity: REFERENCE elements_per_wall: 8 predicted_seconds: 99999
      errors { measure: "support plateau, Type I, 100 m/s" uncertainty_relative: 0.009 }
      errors { measure: "limit stress, Example 1, 1 m/s" uncertainty_relative: 0.002 } })");
  for (const int width : {120, 80, 60, 40}) {
    const std::string text = fidelity_text(check, width);
    expect_parts_in(text, {"20 min 00 s", "27 h 46 min", "11.4 %", "± 2.8 %", "± 0.2 %", "± 0.9 %"});
    expect_no_wider(text, width);
  }
}

TEST(FidelityText, WhatTheCaseGivesOtherwiseHasNoKnownError) {
  v1::CheckCaseResponse check;
  EXPECT_EQ(fidelity_text(check, 120), "");
  check = from_text<v1::CheckCaseResponse>(R"(
    fidelities { fidelity: DRAFT elements_per_wall: 1 given_fields: "section.depth_rule" }
    fidelities { fidelity: REFERENCE elements_per_wall: 2 given_fields: "section.depth_rule" })");
  const std::string text = fidelity_text(check, 120);
  expect_parts_in(text, {"REFERENCE", "not known", "differs from every measured preset in section.depth_rule."});
  EXPECT_EQ(text.find("scatters"), std::string::npos) << text;
}

TEST(FidelityText, WhereTheCaseLeavesNothingToFillInOneSentenceSaysSo) {
  const auto check = from_text<v1::CheckCaseResponse>(R"(
    fidelities { fidelity: DRAFT elements_per_wall: 10 } fidelities { fidelity: REFERENCE elements_per_wall: 10 })");
  const std::string text = fidelity_text(check, 120);
  expect_parts_in(
      text, {"changes nothing", "sets elements_per_wall", "mesh error is not", "`cellcrush converge` estimates it."});
  EXPECT_EQ(text.find("REFERENCE"), std::string::npos) << text;
}

TEST(JobText, AFramesSummaryHasNoPlateau) {
  const auto job = from_text<v1::Job>(R"(name: "jobs/1" state: SUCCEEDED
    words { facts { heading: "watched nodes" } } summary { energy_error_relative: 0.001 })");
  const std::string text = description_text(job);
  expect_parts_in(text, {"energy ledger error", "0.10 %", "watched nodes"});
  EXPECT_EQ(text.find("plateau"), std::string::npos) << text;
}

}  // namespace
}  // namespace cellcrush::client
