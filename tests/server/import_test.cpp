// Results of one daemon as jobs of another.
#include <gmock/gmock.h>

#include <fstream>

#include "error.h"
#include "programs/process.h"
#include "server/daemon_fixture.h"
#include "server/job_numbers.h"
#include "store/hdf5.h"
#include "store/result_import.h"
#include "store/result_seal.h"
#include "store/verification.h"

namespace cellcrush::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ImportTest : public DaemonFixture {
 protected:
  [[nodiscard]] fs::path other() const { return folder_.path() / "other"; }
  [[nodiscard]] fs::path file() const { return folder_.path() / "result.h5"; }

  // A copy of the result of jobs/1.
  void take_result() const { fs::copy_file(data_folder() / "jobs/1/result.h5", file()); }

  // As versions wrote it that had no attribute for the job.
  void take_away_job_attribute() const {
    const store::Hdf5Handle open(H5Fopen(file().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    if (H5Aexists(open.id(), "job") > 0) store::check_hdf5(H5Adelete(open.id(), "job"), "delete");
  }

  void restart_on_the_other() {
    daemon_.reset();
    auto options = default_options();
    options.data_folder = other();
    start(options);
  }

  [[nodiscard]] std::string refusal(const std::vector<fs::path>& files) const {
    try {
      store::import_results(other(), files, store::Import::copy);
    } catch (const ServiceError& error) {
      return error.what();
    }
    return "not refused";
  }
};

TEST_F(ImportTest, AResultIsAnEndedJobWithTheNumbersThatItHad) {
  auto client = this->client();
  finished_job();
  take_result();
  take_away_job_attribute();
  store::seal_result(file());
  const auto numbers = numbers_of(client, data_folder(), "jobs/1");
  auto before = client.get("jobs/1");
  // No attribute has them.
  before.mutable_summary()->clear_end();
  before.mutable_summary()->clear_end_words();
  EXPECT_THAT(store::import_results(other(), {file(), data_folder() / "jobs/1"}, store::Import::copy),
              ::testing::ElementsAre(1, 2));
  EXPECT_THAT(store::verify_folder(other()).problems, IsEmpty());
  fs::remove(file());
  restart_on_the_other();
  auto next = this->client();
  for (const std::string job : {"jobs/1", "jobs/2"}) {
    EXPECT_TRUE(numbers_of(next, other(), job).history == numbers.history) << job;
    EXPECT_TRUE(numbers_of(next, other(), job).frames == numbers.frames) << job;
    auto summary = next.get(job).summary();
    summary.clear_end();
    summary.clear_end_words();
    EXPECT_EQ(summary.DebugString(), before.summary().DebugString());
    EXPECT_EQ(next.get(job).case_().SerializeAsString(), before.case_().SerializeAsString());
    EXPECT_EQ(next.get(job).state(), v1::Job::SUCCEEDED);
    EXPECT_TRUE(watch_soundly(next, job).ok());
  }
  EXPECT_TRUE(next.remove("jobs/1").ok());
  EXPECT_EQ(next.create(small_case()), "jobs/3");
}

TEST_F(ImportTest, WhatIsNoResultIsNamedWithTheRemedyAndNothingIsMade) {
  finished_job();
  take_result();
  std::ofstream(folder_.path() / "text.h5") << "no HDF5";
  std::ofstream(folder_.path() / "foreign.h5") << "\x89HDF\r\n\x1a\n";
  fs::copy_file(file(), folder_.path() / "short.h5");
  fs::resize_file(folder_.path() / "short.h5", fs::file_size(file()) / 2);
  const auto at = [this](const char* name) { return folder_.path() / name; };
  const std::string why =
      refusal({file(), at("text.h5"), at("foreign.h5"), at("short.h5"), at("absent"), other() / ".."});
  EXPECT_THAT(why, AllOf(HasSubstr("text.h5: not a result of cellcrush"), HasSubstr("foreign.h5: an HDF5 file without"),
                         HasSubstr("short.h5: the file is damaged or incomplete"), HasSubstr("absent: no such file")));
  EXPECT_FALSE(fs::exists(other()));
  EXPECT_THAT(refusal({folder_.path() / "data"}), HasSubstr("data: this folder has no result.h5"));
  EXPECT_THAT(refusal({folder_.path() / std::string(300, 'x')}), HasSubstr("File name too long"));
  const auto used = e2e::run({CELLCRUSHD_PROGRAM, "import", "--data", data_folder().string(), file().string()},
                             std::chrono::seconds(30));
  EXPECT_EQ(used.exit_code, 1);
  EXPECT_THAT(used.errors, HasSubstr("in use by a running daemon"));
}

}  // namespace
}  // namespace cellcrush::testing
