// Workers that get too little memory.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <iostream>
#include <set>

#include "faults/rounds.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

class LittleMemoryTest : public DaemonFixture {
 protected:
  void SetUp() override {
    std::ofstream(script()) << "#!/bin/sh\nulimit -v \"$(cat " << limit().string() << ")\"\nexec " << CELLCRUSHD_PROGRAM
                            << " \"$@\"\n";
    ASSERT_EQ(chmod(script().c_str(), 0700), 0);
    auto options = default_options();
    options.worker_program = script();
    start(options);
  }

  // For the workers that start from now on.
  void limit_memory(const std::string& kibibytes) const {
    std::ofstream file(limit(), std::ios::trunc);
    file << kibibytes << "\n";
  }

  [[nodiscard]] std::filesystem::path script() const { return folder_.path() / "worker"; }
  [[nodiscard]] std::filesystem::path limit() const { return folder_.path() / "limit"; }
};

TEST_F(LittleMemoryTest, AWorkerThatRunsOutOfMemoryFailsItsJobAndTheDaemonGoesOn) {
  auto client = this->client();
  v1::Case wide = endless_case();
  wide.mutable_lattice()->mutable_hexagon()->set_columns(300);
  wide.mutable_lattice()->mutable_hexagon()->set_rows(300);
  std::set<v1::JobCause> causes;
  const int step = rounds(64, 16);
  for (int mebibytes = 32; mebibytes <= 256; mebibytes += step) {
    limit_memory(std::to_string(mebibytes * 1024));
    const std::string job = client.create(wide);
    if (!client.wait_for_state(job, v1::FAILED)) {
      // There was enough.
      std::cout << mebibytes << " MiB: " << v1::JobState_Name(client.get(job).state()) << "\n";
      ASSERT_TRUE(client.cancel(job).ok());
      break;
    }
    const auto failed = client.get(job);
    EXPECT_TRUE(failed.cause() == v1::OUT_OF_MEMORY || failed.cause() == v1::WORKER_CRASHED) << failed.cause();
    EXPECT_FALSE(failed.remedy().empty());
    causes.insert(failed.cause());
    std::cout << mebibytes << " MiB: " << v1::JobCause_Name(failed.cause()) << ", " << failed.cause_message() << "\n";
  }
  EXPECT_TRUE(causes.contains(v1::OUT_OF_MEMORY));
  limit_memory("unlimited");
  const std::string next = client.create(small_case());
  EXPECT_TRUE(client.watch(next).status.ok());
  EXPECT_EQ(client.get(next).state(), v1::SUCCEEDED) << client.get(next).cause_message();
}

}  // namespace
}  // namespace cellcrush::testing
