// What a daemon asks of Slurm after a job ran out of memory there. Commands that run tasks here stand in for Slurm's.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "server/daemon_fixture.h"
#include "slurm/cluster_options.h"

namespace cellcrush::testing {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class MemoryRequestTest : public DaemonFixture {
 protected:
  void SetUp() override {
    fs::create_directories(commands());
    fs::create_directories(shared());
    for (const char* name : {"sacct", "scancel"}) command(name, "exit 0");
    command("squeue", "if [ -e $HERE/tasks ]; then cat $HERE/tasks; fi");
  }

  void command(const std::string& name, const std::string& script) const {
    std::ofstream(commands() / name) << "#!/bin/sh\nHERE=" << commands().string() << "\n" << script << "\n";
    chmod((commands() / name).c_str(), 0755);
  }

  // A daemon whose sbatch notes the memory that is asked for. `first` is how it runs the script of its first job.
  void start_with(const std::string& first) {
    command("sbatch", R"(for word in "$@"; do
  case $word in
    --mem=*) echo ${word#--mem=} >> $HERE/asked;;
    --job-name=*) name=${word#--job-name=};;
  esac
done
number=$(wc -l < $HERE/asked)
state() { echo "$number|N/A|$1|None|n1|$name" > $HERE/tasks; }
state RUNNING
if [ $number -gt 1 ]; then sh $word & else )" +
                          first + R"(
fi > /dev/null 2>&1
echo $number)");
    slurm::ClusterOptions cluster;
    cluster.name = "test";
    cluster.folder = shared();
    cluster.program = CELLCRUSHD_PROGRAM;
    cluster.commands = commands();
    cluster.times = {.look = milliseconds(20), .squeue = milliseconds(100), .silent = milliseconds(600)};
    auto options = default_options();
    options.executors.push_back(slurm::executor_of(cluster));
    start(options);
  }

  // A job on the cluster succeeds with its second attempt. Returns why the first one was lost.
  std::string loss_of_job() {
    auto client = this->client();
    auto request = job_of(small_case());
    request.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_rows(4000);
    request.mutable_case_()->mutable_loading()->set_end_strain(0.002);
    request.set_executor("slurm/test");
    const std::string job = client.create(request).name();
    std::string messages;
    for (const auto& event : client.watch(job).events) messages += event.state().cause_message();
    EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << client.get(job).DebugString();
    EXPECT_EQ(client.get(job).attempt(), 2);
    return messages;
  }

  // Of each sbatch, MiB.
  [[nodiscard]] std::vector<int> asked() const {
    std::ifstream file(commands() / "asked");
    std::vector<int> out;
    for (std::string line; std::getline(file, line);) out.push_back(std::stoi(line));
    return out;
  }

  [[nodiscard]] fs::path commands() const { return folder_.path() / "commands"; }
  [[nodiscard]] fs::path shared() const { return folder_.path() / "shared"; }
};

TEST_F(MemoryRequestTest, RisesAfterAWorkerMetItsLimit) {
  start_with("(ulimit -d 40000; exec sh $word) &");
  EXPECT_THAT(loss_of_job(), AllOf(HasSubstr("MiB of memory that it was allowed"), HasSubstr("is allowed more.")));
  ASSERT_EQ(asked().size(), 2U);
  EXPECT_GT(asked()[1], asked()[0]);
}

TEST_F(MemoryRequestTest, RisesAfterSlurmKilledATaskForItsMemory) {
  start_with("{ sh $word & until ls " + shared().string() +
             "/attempts/*/claim; do sleep .02; done; kill -9 $!; state OUT_OF_MEMORY; }");
  EXPECT_THAT(loss_of_job(), AllOf(HasSubstr("OUT_OF_MEMORY"), HasSubstr("is allowed more.")));
  ASSERT_EQ(asked().size(), 2U);
  EXPECT_GT(asked()[1], asked()[0]);
}

}  // namespace
}  // namespace cellcrush::testing
