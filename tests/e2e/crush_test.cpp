// The whole way of a case: submitted, watched, fetched, drawn.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

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
  EXPECT_THAT(outcome.all(), ::testing::ContainsRegex("[Tt]heory"));
  EXPECT_THAT(outcome.output, ::testing::Not(HasSubstr("\x1b["))) << "Escape codes where there is no terminal.";
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

TEST_F(Crush, TheFetchedFilesAreThere) {
  const std::filesystem::path out = folder() / "out";
  const Outcome fetched = cellcrush({"fetch", crush(), "-o", out.string()});
  ASSERT_EQ(fetched.exit_code, 0) << fetched.all();
  EXPECT_GT(std::filesystem::file_size(out / "result.h5"), 10'000U);
  std::ifstream history(out / "history.csv");
  EXPECT_GT(std::count(std::istreambuf_iterator<char>(history), {}, '\n'), 100);
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
  EXPECT_THAT(text.output, ::testing::ContainsRegex("crush mode: layer by layer \\(I\\)"));
  EXPECT_THAT(text.output, HasSubstr("contact damping"));
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
