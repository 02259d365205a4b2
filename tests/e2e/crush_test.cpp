// The whole way of a case: submitted, watched, fetched, drawn.
#include <gmock/gmock.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

/// Reads a result.h5 with the C interface of HDF5. Every function throws std::runtime_error, naming the object, when
/// something is not there or cannot be read. Not thread-safe.
class ResultFile {
 public:
  explicit ResultFile(const std::filesystem::path& path);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Extent of a dataset.
  [[nodiscard]] std::vector<std::int64_t> shape(const std::string& name) const;
  /// All values of a dataset, rows first.
  [[nodiscard]] std::vector<double> values(const std::string& name) const;
  /// Whether a dataset may grow along its first dimension, and is compressed.
  [[nodiscard]] bool is_extendible_and_compressed(const std::string& name) const;
  /// Bytes of a number of the dataset.
  [[nodiscard]] int number_size(const std::string& name) const;
  /// Names of the attributes of the root group, sorted.
  [[nodiscard]] std::vector<std::string> attributes() const;

 private:
  std::int64_t file_ = -1;
};

// Closes an HDF5 object at the end of a scope; throws when opening it has failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error(what + " is not there or cannot be read");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle open_dataset(hid_t file, const std::string& name) {
  return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

std::vector<std::int64_t> extent(hid_t dataset, const std::string& name) {
  const Handle space(H5Dget_space(dataset), H5Sclose, name);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.id())));
  H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

ResultFile::ResultFile(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw std::runtime_error(path.string() + " is not a complete HDF5 file");
}

ResultFile::~ResultFile() { H5Fclose(file_); }

std::vector<std::int64_t> ResultFile::shape(const std::string& name) const {
  return extent(open_dataset(file_, name).id(), name);
}

std::vector<double> ResultFile::values(const std::string& name) const {
  const Handle dataset = open_dataset(file_, name);
  std::size_t count = 1;
  for (const std::int64_t size : extent(dataset.id(), name)) count *= static_cast<std::size_t>(size);
  std::vector<double> numbers(count);
  if (H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
    throw std::runtime_error(name + " cannot be read");
  return numbers;
}

bool ResultFile::is_extendible_and_compressed(const std::string& name) const {
  const Handle dataset = open_dataset(file_, name);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, name);
  const Handle properties(H5Dget_create_plist(dataset.id()), H5Pclose, name);
  std::vector<hsize_t> largest(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.id())));
  H5Sget_simple_extent_dims(space.id(), nullptr, largest.data());
  return !largest.empty() && largest[0] == H5S_UNLIMITED && H5Pget_nfilters(properties.id()) > 0;
}

int ResultFile::number_size(const std::string& name) const {
  const Handle dataset = open_dataset(file_, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, name);
  return static_cast<int>(H5Tget_size(type.id()));
}

std::vector<std::string> ResultFile::attributes() const {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  H5Aiterate2(file_, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

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
