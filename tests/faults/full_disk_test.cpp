// A data folder on a disk that becomes full.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <thread>

#include "faults/fault_fixture.h"
#include "faults/rounds.h"
#include "server/job_numbers.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

class FullDiskTest : public FaultFixture {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(data_folder());
    if (mount("tmpfs", data_folder().c_str(), "tmpfs", MS_NOSUID | MS_NODEV, "size=48m,mode=0700") != 0)
      GTEST_SKIP() << "No small file system can be mounted here: " << std::strerror(errno);
    mounted_ = true;
  }

  void TearDown() override {
    FaultFixture::TearDown();
    if (!mounted_) return;
    // Workers that were killed may hold it for an instant.
    for (int i = 0; i < 100 && umount2(data_folder().c_str(), 0) != 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  void fill_the_disk() const {
    std::ofstream file(filler(), std::ios::binary | std::ios::app);
    const std::string block(4096, 'x');
    while (file.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) continue;
  }

  [[nodiscard]] std::filesystem::path filler() const { return data_folder() / "filler"; }

  bool mounted_ = false;
};

TEST_F(FullDiskTest, AFullDiskEndsTheJobWithACauseAndTheDaemonGoesOnOnceThereIsRoom) {
  // Nothing is kept free, so that the disk gets full.
  start_daemon({"--workers", "1", "--checkpoint-interval", "0.05", "--min-free-disk", "0"});
  auto client = this->client();
  const std::string job = client.create(endless_case());
  wait_for_samples(client, job, 20);
  fill_the_disk();
  v1::CreateJobRequest request;
  *request.mutable_case_() = small_case();
  v1::Job refused;
  grpc::Status status;
  for (int i = 0; i < 200 && status.ok(); ++i) {
    fill_the_disk();
    status = client.jobs->CreateJob(bounded_context().get(), request, &refused);
  }
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << status.error_message();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  fill_the_disk();
  EXPECT_EQ(client.get(job).name(), job) << "What needs no room is served.";

  std::filesystem::remove(filler());
  for (int i = 0; i < 200 && client.get(job).state() == v1::RUNNING; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto ended = client.get(job);
  std::cout << "on a full disk: CreateJob " << status.error_message()
            << "; the job: " << v1::JobState_Name(ended.state()) << " " << v1::JobCause_Name(ended.cause()) << " "
            << ended.cause_message() << "\n";
  if (ended.state() == v1::FAILED) {
    EXPECT_TRUE(ended.cause() == v1::DISK_FULL || ended.cause() == v1::WORKER_CRASHED);
    EXPECT_FALSE(ended.remedy().empty());
  } else {
    EXPECT_TRUE(client.cancel(job).ok());
  }
  const std::string next = client.create(small_case());
  for (const auto& waiting : all_jobs(client))
    EXPECT_TRUE(waiting.first == job || client.watch(waiting.first).status.ok());
  EXPECT_EQ(client.get(next).state(), v1::SUCCEEDED) << client.get(next).cause_message();
}

TEST_F(FullDiskTest, AJobThatCouldNotBeEndedOnAFullDiskIsEndedOnceThereIsRoom) {
  // With little room all jobs are left; the disk is full before that is seen.
  start_daemon({"--workers", "1", "--checkpoint-interval", "0.05", "--min-free-disk", "20"});
  auto client = this->client();
  for (int i = 0; i < rounds(1, 5); ++i) {
    const std::string job = client.create(endless_case());
    wait_for_samples(client, job, 20);
    for (int filling = 0; filling < 70; ++filling) {
      fill_the_disk();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    std::filesystem::remove(filler());
    // It has FAILED or goes on; whichever it is, somebody has it.
    for (int look = 0; look < 200 && client.get(job).state() == v1::PENDING; ++look)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    (void)client.cancel(job);
    for (int look = 0; look < 400 && client.get(job).state() != v1::CANCELLED && client.get(job).state() != v1::FAILED;
         ++look)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto ended = client.get(job);
    std::cout << "on a full disk with jobs held: " << v1::JobState_Name(ended.state()) << " " << ended.cause_message()
              << "\n";
    EXPECT_TRUE(ended.state() == v1::CANCELLED || ended.state() == v1::FAILED);
  }
}

}  // namespace
}  // namespace cellcrush::testing
