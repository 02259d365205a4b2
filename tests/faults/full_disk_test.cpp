// A data folder on a disk that becomes full.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

class FullDiskTest : public FaultFixture {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(data_folder());
    if (mount("tmpfs", data_folder().c_str(), "tmpfs", MS_NOSUID | MS_NODEV, "size=64m,mode=0700") != 0)
      GTEST_SKIP() << "No small file system can be mounted here: " << std::strerror(errno);
    mounted_ = true;
  }

  void TearDown() override {
    FaultFixture::TearDown();
    if (!mounted_) return;
    // Workers that were killed may hold it for an instant.
    wait_until([this] { return umount2(data_folder().c_str(), 0) == 0; }, std::chrono::seconds(5));
  }

  // Disks of 64, 128 and 256 MiB take turns. REQUIRES: the disk is not filled.
  void resize_the_disk(int round) const {
    const std::string size = "size=" + std::to_string(64 << (round % 3)) + "m";
    ASSERT_EQ(mount("tmpfs", data_folder().c_str(), "tmpfs", MS_NOSUID | MS_NODEV | MS_REMOUNT, size.c_str()), 0)
        << std::strerror(errno);
  }

  // Leaves so much room, less than a page more.
  void fill_the_disk(std::uintmax_t left = 0) const {
    std::ofstream file(filler(), std::ios::binary | std::ios::app);
    const std::string block(4096, 'x');
    while (file.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) continue;
    file.close();
    if (left > 0) std::filesystem::resize_file(filler(), std::filesystem::file_size(filler()) - left);
  }

  // Takes all room that comes free meanwhile, too.
  void keep_the_disk_full(std::chrono::milliseconds time) const {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
      fill_the_disk();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  void make_room() const { std::filesystem::remove(filler()); }

  [[nodiscard]] std::filesystem::path filler() const { return data_folder() / "filler"; }

  // Nothing is kept free, so that the disk gets full.
  void start() { start_daemon({"--workers", "1", "--checkpoint-interval", "0.05", "--min-free-disk", "0"}); }

  static v1::Case submitted() {
    v1::Case out = case_of_seconds();
    out.mutable_loading()->set_speed_m_per_s(12.0);
    return out;
  }

  // Of a run that nothing disturbs.
  JobNumbers undisturbed(Client& client) {
    const std::string job = client.create(submitted());
    expect_success(client, job);
    return numbers_of(client, data_folder(), job);
  }

  void expect_the_same_end(Client& client, const std::string& job, const JobNumbers& whole) const {
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED))
        << v1::Job::State_Name(client.get(job).state()) << " " << client.get(job).cause_message();
    EXPECT_TRUE(numbers_of(client, data_folder(), job) == whole);
    EXPECT_TRUE(client.remove(job).ok());
  }

  // What can be read is, and no job has failed.
  static void expect_service(Client& client) {
    for (const auto& [name, job] : all_jobs(client)) {
      EXPECT_NE(job.state(), v1::Job::FAILED) << name << ": " << job.cause_message();
      EXPECT_EQ(client.get(name).name(), name);
    }
  }

  bool mounted_ = false;
};

TEST_F(FullDiskTest, WheneverItFillsNoJobFailsAndEachReachesItsEndWithTheSameBits) {
  start();
  auto client = this->client();
  const auto begin = std::chrono::steady_clock::now();
  const auto whole = undisturbed(client);
  const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  const int moments = rounds(2, 40);
  for (int i = 0; i <= moments; ++i) {
    resize_the_disk(i);
    const std::string job = client.create(submitted());
    // The last moments are those at which the result is closed.
    std::this_thread::sleep_for(i * time / moments);
    keep_the_disk_full(std::chrono::milliseconds(rounds(700, 1200)));
    expect_service(client);
    make_room();
    expect_the_same_end(client, job, whole);
  }
  const std::string log = stop_daemon();
  std::cout << moments + 1 << " fillings within " << time.count() << " ms\n" << log;
}

TEST_F(FullDiskTest, WhileItIsFullNothingIsTakenAndWhatWaitsRunsAfterwards) {
  start();
  auto client = this->client();
  const std::string running = client.create(endless_case());
  const std::string waiting = client.create(submitted());
  wait_for_samples(client, running, 20);
  keep_the_disk_full(std::chrono::milliseconds(1000));
  grpc::Status status;
  for (int i = 0; i < 200 && status.ok(); ++i) {
    fill_the_disk();
    status = client.try_to(job_of(small_case()));
  }
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << status.error_message();
  expect_service(client);
  make_room();
  EXPECT_TRUE(client.wait_for_state(running, v1::Job::RUNNING));
  EXPECT_TRUE(client.cancel(running).ok());
  EXPECT_TRUE(client.wait_for_state(running, v1::Job::CANCELLED));
  EXPECT_TRUE(client.wait_for_state(waiting, v1::Job::SUCCEEDED));
}

TEST_F(FullDiskTest, AJobThatIsCancelledOrSuspendedMeanwhileIsOnceThereIsRoom) {
  start();
  auto client = this->client();
  const auto whole = undisturbed(client);
  for (int i = 0; i < rounds(1, 10); ++i) {
    resize_the_disk(i);
    const std::string cancelled = create_with_samples(client, endless_case(), 10);
    {
      const std::jthread fills([this] { keep_the_disk_full(std::chrono::milliseconds(rounds(700, 1500))); });
      std::this_thread::sleep_for(std::chrono::milliseconds(37 * i));
      (void)client.cancel(cancelled);
    }
    make_room();
    // A cancel that could not be noted is made again.
    wait_until([&] { return client.cancel(cancelled).ok(); });
    EXPECT_TRUE(client.wait_for_state(cancelled, v1::Job::CANCELLED))
        << v1::Job::State_Name(client.get(cancelled).state());

    const std::string suspended = create_with_samples(client, submitted(), 10);
    {
      const std::jthread fills([this] { keep_the_disk_full(std::chrono::milliseconds(rounds(700, 1500))); });
      std::this_thread::sleep_for(std::chrono::milliseconds(37 * i));
      (void)client.suspend(suspended);
    }
    make_room();
    expect_service(client);
    // A suspend that could not be noted may be noted only now.
    wait_until([&] {
      (void)client.resume(suspended);
      return client.get(suspended).state() == v1::Job::SUCCEEDED;
    });
    expect_the_same_end(client, suspended, whole);
  }
}

TEST_F(FullDiskTest, ADaemonStartsWithNextToNoRoomServesReadingAndRunsNothingUntilThereIsRoom) {
  start();
  JobNumbers whole;
  {
    auto client = this->client();
    whole = undisturbed(client);
  }
  const int step = rounds(72, 4);
  for (int kibibytes = 0; kibibytes <= 72; kibibytes += step) {
    resize_the_disk(kibibytes / step);
    std::string job;
    {
      auto client = this->client();
      job = create_with_samples(client, submitted(), 20);
    }
    const bool killed = kibibytes / step % 2 == 1;
    if (killed) {
      kill_daemon();
      kill_workers(data_folder());
    } else {
      stop_daemon();
    }
    fill_the_disk(static_cast<std::uintmax_t>(kibibytes) * 1024);
    ASSERT_NO_FATAL_FAILURE(start()) << kibibytes << " KiB";
    auto client = this->client();
    expect_service(client);
    keep_the_disk_full(std::chrono::milliseconds(rounds(500, 1000)));
    EXPECT_NE(client.get(job).state(), v1::Job::FAILED);
    expect_service(client);
    make_room();
    expect_the_same_end(client, job, whole);
  }
}

}  // namespace
}  // namespace cellcrush::testing
