// The whole way of a case: submitted, watched, fetched, drawn.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "e2e/daemon_test.h"
#include "e2e/result_file.h"

namespace cellcrush::e2e {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

// The objects of a stream in JSON, one a line; a line that is none fails the test.
std::vector<json> parse_lines(const std::string& text) {
  std::vector<json> objects;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    json object = json::parse(line, nullptr, false);
    EXPECT_TRUE(object.is_object()) << "Not an object of JSON: " << line;
    objects.push_back(std::move(object));
  }
  return objects;
}

class Crush : public DaemonTest {
 protected:
  // Submits the small case, watches it to its end and returns its name.
  std::string crush() {
    const Outcome submitted =
        cellcrush({"submit", write_file("small.txtpb", small_case()), "--watch", "--json"}, kCrushLimit);
    EXPECT_EQ(submitted.exit_code, 0) << submitted.all();
    for (const json& object : parse_lines(submitted.output)) {
      if (object.contains("snapshot")) return object["snapshot"]["job"]["name"].get<std::string>();
    }
    ADD_FAILURE() << "No snapshot in the stream:\n" << submitted.all();
    return "";
  }
};

TEST_F(Crush, SubmitAndWatchShowsBothPlateausBesideTheory) {
  const Outcome outcome = cellcrush({"submit", write_file("small.txtpb", small_case()), "--watch"}, kCrushLimit);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.all(), HasSubstr("jobs/"));
  EXPECT_THAT(outcome.all(), HasSubstr("SUCCEEDED"));
  EXPECT_THAT(outcome.all(), HasSubstr("MPa"));
  EXPECT_THAT(outcome.all(), testing::ContainsRegex("[Tt]heory"));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("\x1b["))) << "Escape codes where there is no terminal.";
}

TEST_F(Crush, TheStreamIsASnapshotThenStatesAndSamplesCountedWithoutAGap) {
  const Outcome outcome =
      cellcrush({"submit", write_file("small.txtpb", small_case()), "--watch", "--json"}, kCrushLimit);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  std::vector<json> events = parse_lines(outcome.output);
  // A line with the job itself may come before the events.
  std::erase_if(events, [](const json& object) { return object.contains("name"); });
  ASSERT_FALSE(events.empty());
  ASSERT_TRUE(events[0].contains("snapshot")) << events[0];
  const auto sequence_of = [](const json& event) {
    if (!event.contains("sequence")) return 0L;
    return event["sequence"].is_string() ? std::stol(event["sequence"].get<std::string>())
                                         : event["sequence"].get<long>();
  };
  long last = sequence_of(events[0]);
  int samples = 0;
  std::string state;
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_FALSE(events[i].contains("snapshot"));
    if (!events[i].contains("sample") && !events[i].contains("state")) continue;
    EXPECT_EQ(sequence_of(events[i]), last + 1) << events[i];
    last = sequence_of(events[i]);
    if (events[i].contains("sample")) ++samples;
    if (events[i].contains("state")) state = events[i]["state"]["state"].get<std::string>();
  }
  EXPECT_EQ(state, "SUCCEEDED");
  EXPECT_GE(samples, 100);
}

TEST_F(Crush, TheFetchedFileHasTheLayoutThatOthersRead) {
  const std::string job = crush();
  const std::filesystem::path out = folder() / "out";
  const Outcome fetched = cellcrush({"fetch", job, "-o", out.string()});
  ASSERT_EQ(fetched.exit_code, 0) << fetched.all();
  ASSERT_TRUE(std::filesystem::exists(out / "result.h5"));
  EXPECT_TRUE(std::filesystem::exists(out / "history.csv"));

  const ResultFile result(out / "result.h5");
  const std::int64_t samples = result.shape("/history/time_s").at(0);
  EXPECT_GE(samples, 100);
  for (const char* column : {"time_s", "travel_mm", "strain", "stress_impact_mpa", "stress_support_mpa",
                             "energy_kinetic_mj", "energy_elastic_mj", "energy_plastic_mj", "energy_contact_mj",
                             "energy_friction_mj", "energy_damping_mj", "work_external_mj", "energy_residual_mj"}) {
    const std::string name = std::string("/history/") + column;
    EXPECT_EQ(result.shape(name), std::vector<std::int64_t>{samples}) << name;
    EXPECT_TRUE(result.is_extendible_and_compressed(name)) << name;
    for (const double value : result.values(name)) ASSERT_TRUE(std::isfinite(value)) << name;
  }

  const std::int64_t particles = result.shape("/mesh/position_mm").at(0);
  const std::int64_t elements = result.shape("/mesh/beam_nodes").at(0);
  EXPECT_EQ(result.shape("/mesh/position_mm"), (std::vector<std::int64_t>{particles, 2}));
  EXPECT_EQ(result.shape("/mesh/beam_nodes"), (std::vector<std::int64_t>{elements, 2}));
  EXPECT_EQ(result.shape("/mesh/thickness_mm"), std::vector<std::int64_t>{elements});
  for (const double node : result.values("/mesh/beam_nodes")) ASSERT_TRUE(node >= 0 && node < double(particles));

  const std::int64_t frames = result.shape("/frames/time_s").at(0);
  EXPECT_GE(frames, 6) << "the undeformed lattice and 5 frames";
  EXPECT_EQ(result.shape("/frames/position_mm"), (std::vector<std::int64_t>{frames, particles, 2}));
  EXPECT_EQ(result.shape("/frames/plastic_fraction"), (std::vector<std::int64_t>{frames, elements}));
  EXPECT_EQ(result.number_size("/frames/position_mm"), 4);
  EXPECT_EQ(result.number_size("/frames/plastic_fraction"), 4);

  const std::vector<double> strain = result.values("/history/strain");
  EXPECT_NEAR(strain.back(), 0.5, 0.01);
  const std::vector<std::string> attributes = result.attributes();
  for (const char* name :
       {"plateau_stress_mpa", "energy_error_relative", "step_count", "crush_mode", "ledger_contact_damping_mj"})
    EXPECT_THAT(attributes, Contains(name));
}

TEST_F(Crush, ThePictureIsAPng) {
  const std::string job = crush();
  const std::filesystem::path picture = folder() / "crush.png";
  const Outcome plotted = cellcrush({"plot", job, "-o", picture.string()});
  ASSERT_EQ(plotted.exit_code, 0) << plotted.all();
  std::ifstream stream(picture, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_GT(bytes.size(), 5000U);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST_F(Crush, AJobIsListedAndShownAlsoAfterARestart) {
  const std::string job = crush();
  stop_daemon();
  start_daemon();
  const Outcome listed = cellcrush({"list"});
  EXPECT_EQ(listed.exit_code, 0) << listed.all();
  EXPECT_THAT(listed.output, HasSubstr(job));
  const Outcome shown = cellcrush({"show", job, "--json"});
  ASSERT_EQ(shown.exit_code, 0) << shown.all();
  const json object = json::parse(shown.output, nullptr, false);
  ASSERT_TRUE(object.is_object()) << shown.output;
  EXPECT_EQ(object["state"], "SUCCEEDED");
  const json& summary = object["summary"];
  EXPECT_GT(summary["plateau_stress_impact_mpa"].get<double>(), 0.0);
  EXPECT_EQ(summary["crush_mode"], "CRUSH_MODE_I");
  EXPECT_GT(summary["ledger"]["contact_damping_mj"].get<double>(), 0.0);
  const Outcome text = cellcrush({"show", job});
  EXPECT_THAT(text.output, testing::ContainsRegex("crush mode: layer by layer \\(I\\)"));
  EXPECT_THAT(text.output, HasSubstr("contact damping"));
}

TEST_F(Crush, APresetPrintsACaseThatIsTakenAgain) {
  const Outcome shown = cellcrush({"show", "preset:hexagon-small"});
  ASSERT_EQ(shown.exit_code, 0) << shown.all();
  const Outcome checked = cellcrush({"check", write_file("again.txtpb", shown.output)});
  EXPECT_EQ(checked.exit_code, 0) << checked.all();
}

TEST_F(Crush, CheckCountsTheLatticeOfTypeI) {
  const Outcome checked = cellcrush({"check", "preset:type-i", "--json"});
  ASSERT_EQ(checked.exit_code, 0) << checked.all();
  const json object = json::parse(checked.output, nullptr, false);
  ASSERT_TRUE(object.is_object()) << checked.output;
  EXPECT_EQ(object["particle_count"], "8099");
  EXPECT_EQ(object["element_count"], "9642");
  EXPECT_NEAR(object["mass_g"].get<double>(), 72.15, 0.01);
}

}  // namespace
}  // namespace cellcrush::e2e
