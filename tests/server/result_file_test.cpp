#include <gmock/gmock.h>
#include <hdf5.h>
#include <zlib.h>

#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "error.h"
#include "programs/temporary_folder.h"
#include "programs/text_proto.h"
#include "server/refuses.h"
#include "server/small_case.h"
#include "store/case_hash.h"
#include "store/result_seal.h"
#include "store/result_writer.h"
#include "store/sample_reader.h"

namespace cellcrush::store {
namespace {

constexpr int kSamples = 600;  // more than two chunks

// What the layout says, read with HDF5 itself.
std::vector<hsize_t> shape(hid_t file, const std::string& path) {
  const Hdf5Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path);
  return shape_of(dataset.id());
}

bool is_type(hid_t file, const std::string& path, hid_t type) {
  const Hdf5Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path);
  const Hdf5Handle stored(H5Dget_type(dataset.id()), H5Tclose, path);
  return H5Tequal(stored.id(), type) > 0;
}

double number_attribute(hid_t file, const char* name) {
  const Hdf5Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, name);
  double value = 0.0;
  H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value);
  return value;
}

class ResultFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(path_.parent_path());
    const auto mesh = testing::from_text<v1::Mesh>(
        "particle_count: 3 element_nodes: [0, 1, 1, 2] thickness_mm: [0.5, 0.25] "
        "element_wall: [0, 1] rigid_element_count: 1 overlap_particle: [0, 2]");
    ResultWriter writer(path_, mesh);
    for (int i = 0; i < kSamples; ++i) {
      v1::Sample sample;
      sample.set_step(7 * i);
      sample.set_time_s(i);
      sample.set_strain(0.001 * i);
      sample.set_energy_contact_damping_mj(2.0 * i);
      sample.set_deepest_penetration(0.5);
      if (i >= 100) sample.mutable_front()->set_strain_behind(0.9);
      if (i == 20) sample.add_breaks()->set_element(1);
      sample.set_break_count(i < 20 ? 0 : 1);
      writer.add_sample(sample);
    }
    for (int i = 0; i < 4; ++i) {
      v1::FieldFrame frame;
      frame.set_index(i);
      frame.set_time_s(10.0 * i);
      frame.set_strain(0.1 * i);
      for (int k = 0; k < 6; ++k) frame.add_position_mm(static_cast<float>(100 * i + k));
      for (int k = 0; k < 2; ++k) frame.add_plastic_fraction(static_cast<float>(i) / 4.0F);
      for (int k = 0; k < 2; ++k) frame.add_fibre_strain(0.01F * static_cast<float>(i + k));
      for (int k = 0; k < 2; ++k) frame.add_local_strain(0.02F * static_cast<float>(i + k));
      if (i >= 2) {
        frame.add_broken_end(2);
        frame.add_end_position_mm(1.0F);
        frame.add_end_position_mm(2.0F);
      }
      writer.add_frame(frame);
    }
    const auto summary = testing::from_text<v1::Summary>(R"(
      plateau_stress_impact_mpa: 3.25 step_count: 12345 energy_error_relative: 0.01 crush_mode: CRUSH_MODE_V
      other_rise: OTHER_RISE_SECOND_COLLAPSE other_rise_strain: 0.7
      front { shock_mpa: 3.3 } ledger { contact_damping_mj: 7.5 } stage_times { find_contacts_s: 0.25 })");
    v1::Job job = testing::from_text<v1::Job>(R"(name: "jobs/7" state: SUCCEEDED owner: "ann" attempt: 1)");
    *job.mutable_case_() = testing::small_case();
    *job.mutable_summary() = summary;
    writer.finish({job, "1.2.3+abc", "scalar", 3, 2e-7, {"Walls are beams.", "No friction."}, "Cite it."});
    file_ = Hdf5Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "opening");
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "jobs/1/result.h5";
  Hdf5Handle file_;
};

TEST_F(ResultFileTest, HasTheDatasetsOfItsPageWithTheirShapesAndTypes) {
  const std::map<std::string, hsize_t> extents = {{"S", kSamples}, {"N", 3}, {"E", 2}, {"W", 2}, {"F", 4}, {"2", 2}};
  const std::map<std::string, hid_t> types = {{"float64", H5T_IEEE_F64LE},
                                              {"float32", H5T_IEEE_F32LE},
                                              {"int64", H5T_STD_I64LE},
                                              {"int32", H5T_STD_I32LE},
                                              {"text", H5T_C_S1}};
  std::ifstream file(RESULT_FORMAT);
  std::set<std::string> found;
  for (std::string line; std::getline(file, line);) {
    std::smatch row;
    if (!std::regex_match(line, row, std::regex(R"(\| `(/[a-z_/]+)` \| ([SNEWF2, ]+) \| (\w+) \| (.*) \|)"))) continue;
    found.insert(row[1]);
    std::vector<hsize_t> wanted;
    std::istringstream words(row[2]);
    for (std::string word; std::getline(words >> std::ws, word, ',');) wanted.push_back(extents.at(word));
    EXPECT_EQ(shape(file_.id(), row[1]), wanted) << row[1];
    EXPECT_TRUE(is_type(file_.id(), row[1], types.at(row[3]))) << row[1];
    const Hdf5Handle dataset(H5Dopen2(file_.id(), row.str(1).c_str(), H5P_DEFAULT), H5Dclose, row[1]);
    EXPECT_EQ(read_text_attribute(dataset.id(), "description"), row[4]) << row[1];
    EXPECT_FALSE(read_text_attribute(dataset.id(), "units").empty()) << row[1];
  }
  for (const HistoryColumn& column : history_columns()) {
    EXPECT_EQ(shape(file_.id(), column.path), std::vector<hsize_t>{kSamples}) << column.path;
    EXPECT_TRUE(is_type(file_.id(), column.path, column.type())) << column.path;
    const Hdf5Handle dataset(H5Dopen2(file_.id(), column.path.c_str(), H5P_DEFAULT), H5Dclose, column.path);
    EXPECT_FALSE(read_text_attribute(dataset.id(), "description").empty()) << column.path;
    EXPECT_FALSE(read_text_attribute(dataset.id(), "units").empty()) << column.path;
    found.insert("/" + column.path);
  }
  EXPECT_EQ(found.size(), 51U) << "Names never change.";
}

TEST_F(ResultFileTest, TheHistoryIsExtendibleAndCompressed) {
  const Hdf5Handle dataset(H5Dopen2(file_.id(), "/history/strain", H5P_DEFAULT), H5Dclose, "strain");
  const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose, "space");
  hsize_t limit = 0;
  H5Sget_simple_extent_dims(space.id(), nullptr, &limit);
  EXPECT_EQ(limit, H5S_UNLIMITED);
  const Hdf5Handle properties(H5Dget_create_plist(dataset.id()), H5Pclose, "properties");
  EXPECT_EQ(H5Pget_layout(properties.id()), H5D_CHUNKED);
  EXPECT_EQ(H5Pget_nfilters(properties.id()), 2);
}

TEST_F(ResultFileTest, SaysWhatItIsAndWhatCameOut) {
  const ResultReader reader(path_);
  EXPECT_EQ(reader.mesh().rigid_element_count(), 1);
  EXPECT_THAT(reader.mesh().overlap_particle(), ::testing::ElementsAre(0, 2));
  EXPECT_NE(reader.text_attribute("case").find("\"wall_thickness_mm\":0.3464"), std::string::npos);
  EXPECT_EQ(reader.text_attribute("case_hash"), hash_of(testing::small_case()));
  EXPECT_EQ(reader.text_attribute("case_hash").size(), 64U);
  EXPECT_EQ(reader.text_attribute("solver_revision"), "1.2.3+abc");
  EXPECT_EQ(reader.text_attribute("simd_target"), "scalar");
  EXPECT_EQ(reader.text_attribute("name"), "jobs/7");
  EXPECT_EQ(reader.text_attribute("owner"), "ann");
  EXPECT_EQ(reader.text_attribute("citation"), "Cite it.");
  const auto job = nlohmann::json::parse(reader.text_attribute("job"));
  EXPECT_EQ(job["state"], "SUCCEEDED");
  EXPECT_EQ(job["summary"]["plateau_stress_impact_mpa"], 3.25);
  EXPECT_EQ(job["case"]["lattice"], nlohmann::json::parse(reader.text_attribute("case"))["lattice"]);
  EXPECT_EQ(reader.text_attribute("modelled"), "Walls are beams.\nNo friction.");
  EXPECT_EQ(number_attribute(file_.id(), "threads"), 3.0);
  EXPECT_EQ(number_attribute(file_.id(), "step_count"), 12345.0);
  EXPECT_EQ(number_attribute(file_.id(), "time_step_s"), 2e-7);
  EXPECT_EQ(number_attribute(file_.id(), "plateau_stress_mpa"), 3.25);
  EXPECT_EQ(number_attribute(file_.id(), "plateau_stress_impact_mpa"), 3.25);
  EXPECT_GT(H5Aexists(file_.id(), "energy_error_relative"), 0);
  EXPECT_EQ(reader.text_attribute("crush_mode"), "V");
  EXPECT_EQ(reader.text_attribute("other_rise"), "SECOND_COLLAPSE");
  EXPECT_EQ(number_attribute(file_.id(), "other_rise_strain"), 0.7);
  EXPECT_EQ(number_attribute(file_.id(), "front_shock_mpa"), 3.3);
  EXPECT_EQ(number_attribute(file_.id(), "ledger_contact_damping_mj"), 7.5);
  EXPECT_EQ(number_attribute(file_.id(), "stage_find_contacts_s"), 0.25);
  EXPECT_EQ(H5Aexists(file_.id(), "quasi_static_kinetic_share"), 0);
  EXPECT_EQ(H5Aexists(file_.id(), "densification_strain"), 0) << "what did not happen is absent";
}

TEST_F(ResultFileTest, IsReadBackAsItWasWritten) {
  const ResultReader reader(path_);
  const auto history = reader.history();
  ASSERT_EQ(history.size(), static_cast<std::size_t>(kSamples));
  for (int i = 0; i < kSamples; ++i) {
    EXPECT_EQ(history[static_cast<std::size_t>(i)].time_s(), i);
    EXPECT_EQ(history[static_cast<std::size_t>(i)].energy_contact_damping_mj(), 2.0 * i);
    EXPECT_EQ(history[static_cast<std::size_t>(i)].step(), 7 * i);
    EXPECT_EQ(history[static_cast<std::size_t>(i)].has_front(), i >= 100) << i;
  }
  EXPECT_EQ(reader.frame_times(), (std::vector<double>{0.0, 10.0, 20.0, 30.0}));
  const auto frame = reader.frame(2);
  EXPECT_EQ(frame.index(), 2);
  EXPECT_EQ(frame.position_mm(5), 205.0F);
  EXPECT_EQ(frame.plastic_fraction(0), 0.5F);
  EXPECT_EQ(frame.fibre_strain(1), 0.03F);
  EXPECT_EQ(frame.local_strain(1), 0.02F * 3.0F);
}

// Groups of HDF5 are in the order of their names, samples in that of the case.
TEST_F(ResultFileTest, PartsOfAFrameAreReadBackInTheOrderOfTheCase) {
  const v1::Case submitted = testing::with_text(
      testing::small_case(), R"(lattice { frame { watched_nodes: ["b", "a"] rigid_walls { id: "floor" } } }
                                loading { sides { kind: RIGID } grips { id: "jaw" } grips { id: "foot" } })");
  std::vector<v1::Sample> samples(kSamples);
  const auto mesh = testing::from_text<v1::Mesh>(
      "particle_count: 3 element_nodes: [0, 1] thickness_mm: 0.5 "
      "element_wall: 0");
  ResultWriter writer(path_ = folder_.path() / "frame.h5", mesh);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].set_step(static_cast<std::int64_t>(i));
    for (const auto& node : submitted.lattice().frame().watched_nodes()) {
      auto& watched = *samples[i].add_watched();
      watched.set_node(node);
      watched.set_uy_mm(0.1 * static_cast<double>(i));
      watched.set_reaction_moment_n_mm(node == "a" ? 1.0 : 2.0);
    }
    auto& wall = *samples[i].add_rigid_walls();
    wall.set_wall("floor");
    wall.set_normal_force_n(1.0 / static_cast<double>(i + 1));
    for (const char* id : {"side_low", "side_high"}) {
      auto& side = *samples[i].add_rigid_walls();
      side.set_wall(id);
      side.set_normal_force_n(id == std::string("side_low") ? 3.0 : 4.0);
    }
    for (const auto& grip : submitted.loading().grips()) {
      auto& added = *samples[i].add_grips();
      added.set_grip(grip.id());
      added.set_force_x_n(grip.id() == "jaw" ? 5.0 : -5.0);
    }
    writer.add_sample(samples[i]);
  }
  v1::Job job;
  *job.mutable_case_() = submitted;
  writer.finish({job, "1.2.3+abc", "scalar", 1, 2e-7, {}});
  const auto read = ResultReader(path_).history(250, 300);
  ASSERT_EQ(read.size(), 300U);
  for (std::size_t i = 0; i < read.size(); ++i)
    ASSERT_EQ(read[i].SerializeAsString(), samples[250 + i].SerializeAsString()) << i;
}

TEST_F(ResultFileTest, ThePredictedSizeIsNotPassedAndNotFarOff) {
  const auto predicted = predicted_result_bytes(3, 2, 2, kSamples, 4);
  const auto real = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  EXPECT_LT(real, predicted);
  EXPECT_GT(16 * real, predicted);
}

TEST_F(ResultFileTest, BeginsAsHdf5AndIsRefusedWithoutTheChecksumAtItsEnd) {
  const std::string whole = testing::text_of_file(path_);
  EXPECT_THAT(whole, ::testing::StartsWith("\x89HDF\r\n\x1a\n"));
  EXPECT_EQ(read_seal(path_), Seal::whole);
  for (const std::size_t cut : {1, 64, 1000}) {
    std::filesystem::resize_file(path_, whole.size() - cut);
    EXPECT_EQ(read_seal(path_), Seal::broken) << cut;
  }
}

TEST_F(ResultFileTest, OneWithItsChecksumAtTheStartIsReadAsBefore) {
  file_ = Hdf5Handle();  // HDF5 would go on reading the file that it has open
  const auto history = ResultReader(path_).history();
  const std::string whole = testing::text_of_file(path_);
  const std::string content = whole.substr(0, whole.size() - 64);
  const auto crc = crc32_z(0, reinterpret_cast<const unsigned char*>(content.data()), content.size());
  std::string block = "CELLCRUSH RESULT 1 " + std::to_string(crc) + " " + std::to_string(content.size()) + "\n";
  block.resize(512, '\0');
  std::ofstream(path_, std::ios::binary) << block << content;
  EXPECT_EQ(ResultReader(path_).history().size(), history.size());
  EXPECT_EQ(ResultReader(path_).frame(3).time_s(), 30.0);
  std::ofstream(path_, std::ios::binary) << block << content.substr(0, content.size() - 1) << "x";
  EXPECT_EQ(read_seal(path_), Seal::broken);
}

// What another program may have put in the place of a part of a result, behind a checksum that fits.
class ChangedResultTest : public ResultFileTest {
 protected:
  // `change` gets the file, in which the dataset is no more, and may put another in its place.
  void replace(const char* dataset, const std::function<void(hid_t file)>& change) {
    file_ = Hdf5Handle();
    Hdf5Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "opening");
    H5Ldelete(file.id(), dataset, H5P_DEFAULT);
    change(file.id());
    file.close("closing");
    seal_result(path_);
  }

  void expect_damaged(const std::function<void(const ResultReader&)>& read) const {
    const ResultReader reader(path_);
    EXPECT_THAT([&] { read(reader); }, testing::Refuses(ServiceError::Kind::data_loss, "The result is damaged"));
  }

  static void read_strains(const ResultReader& reader) { static_cast<void>(reader.frame_strains()); }
  static void read_first(const ResultReader& reader) { static_cast<void>(reader.frame(0)); }
};

TEST_F(ChangedResultTest, AColumnThatAnEarlierVersionLackedIsZero) {
  replace("/history/collapsed_fraction", [](hid_t) {});
  const auto history = ResultReader(path_).history();
  ASSERT_EQ(history.size(), kSamples);
  EXPECT_EQ(history.back().collapsed_fraction(), 0.0);
  EXPECT_GT(history.back().time_s(), 0.0);
  replace("/history/time_s", [](hid_t) {});
  expect_damaged([](const ResultReader& reader) { static_cast<void>(reader.history()); });
}

TEST_F(ChangedResultTest, OneChangedByteAnywhereIsFoundBeforeHdf5ReadsIt) {
  file_ = Hdf5Handle();
  const auto size = std::filesystem::file_size(path_);
  for (const auto offset : {std::uintmax_t{0}, std::uintmax_t{25}, std::uintmax_t{511}, std::uintmax_t{512}, size / 3,
                            size / 2, size - 1}) {
    testing::flip_bits(path_, offset);
    EXPECT_THROW(ResultReader{path_}, ServiceError) << offset;
    testing::flip_bits(path_, offset);
  }
  EXPECT_EQ(ResultReader(path_).frame_times().size(), 4U);
}

TEST_F(ChangedResultTest, AFileThatWasFoundWholeIsReadAgainOnceItChanges) {
  file_ = Hdf5Handle();
  SampleReader samples(folder_.path());
  const SampleRange last{1, 0, kSamples - 1, 2};
  // A younger file is read each time.
  const auto grow_old = [] { std::this_thread::sleep_for(std::chrono::milliseconds(2100)); };
  grow_old();
  for (int i = 0; i < 2; ++i) {
    const auto found = samples.read(last, {});
    ASSERT_EQ(found.samples.size(), 1U);
    EXPECT_TRUE(found.is_cut);
    EXPECT_EQ(found.samples.front().step(), 7 * last.first);
    EXPECT_GT(found.samples.front().strain(), 0.0);
  }
  replace("/history/strain", [](hid_t) {});
  grow_old();
  EXPECT_EQ(samples.read(last, {}).samples.front().strain(), 0.0);
  std::filesystem::resize_file(path_, 1000);
  EXPECT_THROW(samples.read(last, {}), ServiceError);
}

TEST_F(ChangedResultTest, NoLinkLeadsToAnotherFileOrDataset) {
  std::filesystem::copy(path_, path_.parent_path() / "other.h5");
  replace("/frames/strain", [](hid_t file) {
    H5Lcreate_external("other.h5", "/frames/strain", file, "/frames/strain", H5P_DEFAULT, H5P_DEFAULT);
  });
  expect_damaged(read_strains);
  replace("/frames/strain",
          [](hid_t file) { H5Lcreate_soft("/frames/time_s", file, "/frames/strain", H5P_DEFAULT, H5P_DEFAULT); });
  expect_damaged(read_strains);
  replace("/frames",
          [](hid_t file) { H5Lcreate_external("other.h5", "/frames", file, "/frames", H5P_DEFAULT, H5P_DEFAULT); });
  expect_damaged(read_strains);
}

TEST_F(ChangedResultTest, NoDatasetIsMadeOfOtherFiles) {
  std::filesystem::copy(path_, path_.parent_path() / "other.h5");
  const hsize_t four = 4;
  const Hdf5Handle space(H5Screate_simple(1, &four, nullptr), H5Sclose, "space");
  for (const bool is_virtual : {true, false}) {
    const Hdf5Handle storage(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "storage");
    if (is_virtual)
      H5Pset_virtual(storage.id(), space.id(), "other.h5", "/frames/strain", space.id());
    else
      H5Pset_external(storage.id(), (path_.parent_path() / "other.h5").c_str(), 0, 32);
    replace("/frames/strain", [&](hid_t file) {
      const Hdf5Handle made(
          H5Dcreate2(file, "/frames/strain", H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, storage.id(), H5P_DEFAULT),
          H5Dclose, "dataset");
    });
    expect_damaged(read_strains);
  }
}

TEST_F(ChangedResultTest, ADatasetOfAnotherRankOrTypeIsNotReadOverTheEndOfItsBuffer) {
  const std::vector<double> many(4096, 1.0);
  replace("/frames/strain", [&](hid_t file) {
    const auto wide = make_growing_dataset(file, "/frames/strain", H5T_IEEE_F64LE, {1024}, {1, 1024});
    append_rows(wide.id(), H5T_NATIVE_DOUBLE, 4, many.data());
  });
  expect_damaged(read_strains);
  replace("/frames/strain", [&](hid_t file) {
    const auto narrow = make_growing_dataset(file, "/frames/strain", H5T_IEEE_F32LE, {}, {256});
    append_rows(narrow.id(), H5T_NATIVE_DOUBLE, 4, many.data());
  });
  expect_damaged(read_strains);
  replace("/frames/strain", [&](hid_t file) {
    const Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "space");
    const Hdf5Handle made(
        H5Dcreate2(file, "/frames/strain", H5T_IEEE_F64LE, scalar.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose, "dataset");
  });
  expect_damaged(read_strains);
}

TEST_F(ChangedResultTest, ADatasetThatSaysItHoldsMoreThanTheFileCanIsNotMadeRoomFor) {
  replace("/frames/strain", [](hid_t file) {
    const auto empty = make_growing_dataset(file, "/frames/strain", H5T_IEEE_F64LE, {}, {256});
    const hsize_t much = hsize_t{1} << 40U;
    H5Dset_extent(empty.id(), &much);
  });
  expect_damaged(read_strains);
}

TEST_F(ChangedResultTest, AFrameThatIsNotThereIsRefused) {
  for (const int index : {-1, 4, std::numeric_limits<int>::max()})
    expect_damaged([index](const ResultReader& reader) { static_cast<void>(reader.frame(index)); });
  replace("/frames/position_mm", [](hid_t) {});
  expect_damaged(read_first);
}

TEST_F(ChangedResultTest, AnAttributeOfManyTextsIsNotReadAsOne) {
  file_ = Hdf5Handle();
  {
    const Hdf5Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "opening");
    H5Adelete(file.id(), "case");
    const hsize_t count = 64;
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "space");
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    H5Tset_size(type.id(), H5T_VARIABLE);
    const Hdf5Handle made(H5Acreate2(file.id(), "case", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                          "attribute");
    const std::vector<const char*> texts(count, "text");
    H5Awrite(made.id(), type.id(), texts.data());
  }
  seal_result(path_);
  EXPECT_THROW(static_cast<void>(ResultReader(path_).text_attribute("case")), ServiceError);
}

TEST(ResultReader, AnAbsentFileIsRefusedAndOneOfAnEarlierVersionSaysWhatCanBeDone) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "result.h5";
  EXPECT_THROW(ResultReader{path}, ServiceError);
  Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "making").close("closing");
  EXPECT_THAT([&] { const ResultReader reader(path); },
              testing::Refuses(ServiceError::Kind::failed_precondition, "Download the file"));
}

}  // namespace
}  // namespace cellcrush::store
