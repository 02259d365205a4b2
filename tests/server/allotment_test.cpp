// What of its machine the daemon uses: its affinity, control group and Slurm job.
#include "allotment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>
#include <fstream>

#include "programs/temporary_folder.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"

namespace cellcrush::testing {
namespace {

class AllotmentTest : public ::testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) const {
    const auto file = folder_.path() / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  TemporaryFolder folder_;
};

TEST_F(AllotmentTest, TheSmallestQuotaOfTheControlGroupsCounts) {
  write("proc/self/cgroup", "0::/a.slice/b\n");
  write("sys/fs/cgroup/a.slice/cpu.max", "50000 100000\n");
  write("sys/fs/cgroup/a.slice/b/cpu.max", "max 100000\n");
  write("sys/fs/cgroup/a.slice/b/memory.max", "max\n");
  write("sys/fs/cgroup/a.slice/memory.max", "1000000\n");
  EXPECT_EQ(usable_cores(folder_.path()).count, 1);
  EXPECT_EQ(usable_memory(folder_.path()), 1'000'000);
  // Version 1; in a container the path may be that of the host.
  write("proc/self/cgroup", "4:memory:/docker/1\n3:cpu,cpuacct:/docker/1\n");
  write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "150000\n");
  write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "300000\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "2000000\n");
  EXPECT_EQ(usable_cores(folder_.path()).count, 1);
  EXPECT_EQ(usable_memory(folder_.path()), 2'000'000);
  write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  EXPECT_EQ(usable_cores(folder_.path()).text(), usable_cores("/nowhere").text());
}

// `cellcrushd` as it starts on one core of this machine.
void expect_one_core(const std::string& why) {
  const TemporaryFolder folder;
  DaemonProcess daemon({"--data", (folder.path() / "data").string(), "--listen", "127.0.0.1:0"});
  const auto addresses = daemon.wait_for_addresses(1);
  ASSERT_EQ(addresses.size(), 1U);
  const Client client(addresses[0]);
  EXPECT_EQ(client.queue().cores(), "1 core" + why);
  v1::Capabilities capabilities;
  const auto admin = v1::Admin::NewStub(client.channel);
  EXPECT_TRUE(try_call(*admin, &v1::Admin::Stub::GetCapabilities, {}, &capabilities).ok());
  EXPECT_EQ(capabilities.worker_limit(), 1);
  EXPECT_TRUE(daemon.wait_for_error("workers: 1, on 1 core" + why));
}

TEST(Cores, AreThoseThatAffinityOrSlurmLeaveTheDaemon) {
  const bool has_more = usable_cores().count > 1;
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  cpu_set_t one;
  CPU_ZERO(&one);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  expect_one_core(has_more ? " (affinity)" : "");
  ASSERT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
  setenv("SLURM_CPUS_ON_NODE", "1", 1);
  expect_one_core(has_more ? " (Slurm)" : "");
  unsetenv("SLURM_CPUS_ON_NODE");
}

}  // namespace
}  // namespace cellcrush::testing
