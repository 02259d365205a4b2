// Parts of the Slurm executor that need no Slurm.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "error.h"
#include "programs/temporary_folder.h"
#include "slurm/attempt_folder.h"
#include "slurm/batcher.h"
#include "slurm/cluster_options.h"
#include "slurm/commands.h"
#include "slurm/small_file.h"
#include "slurm/task.h"
#include "translate/worker_memory.h"

namespace cellcrush::slurm {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

std::string refusal_of(const std::string& flag) {
  try {
    parse_cluster(flag);
    return "";
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
}

TEST(ClusterFlag, ReadsEverySetting) {
  const auto options = parse_cluster(
      "big:folder=/shared/cc,program=/opt/cellcrushd,commands=/opt/slurm/bin,simd=AVX2,sbatch=--partition=a,"
      "sbatch=--account=b,jobs=7,tasks=5,task-length=9,longest=3600");
  EXPECT_EQ(options.name, "big");
  EXPECT_EQ(options.folder, "/shared/cc");
  EXPECT_EQ(options.program, "/opt/cellcrushd");
  EXPECT_EQ(options.commands, "/opt/slurm/bin");
  EXPECT_EQ(options.simd, "AVX2");
  EXPECT_THAT(options.sbatch, ElementsAre("--partition=a", "--account=b"));
  EXPECT_EQ(options.jobs, 7);
  EXPECT_EQ(options.tasks, 5);
  EXPECT_EQ(options.task_length, seconds(9));
  EXPECT_EQ(options.longest, seconds(3600));
}

TEST(ClusterFlag, NamesWhatIsWrongAndTheRemedy) {
  EXPECT_THAT(refusal_of("folder=/a"), HasSubstr("NAME:folder=PATH"));
  EXPECT_THAT(refusal_of("a b:folder=/a"), HasSubstr("'a b'"));
  EXPECT_THAT(refusal_of("big"), HasSubstr("give folder=PATH"));
  EXPECT_THAT(refusal_of("big:daemon=h:1"), HasSubstr("'daemon=h:1' is not a setting"));
  EXPECT_THAT(refusal_of("big:folder=a"), HasSubstr("folder is 'a'; it must be an absolute path"));
  EXPECT_THAT(refusal_of("big:folder=/a,tusks=3"), HasSubstr("'tusks=3' is not a setting"));
  EXPECT_THAT(refusal_of("big:folder=/a,jobs=many"), HasSubstr("whole number from 1 to 1024"));
  EXPECT_THAT(refusal_of("big:folder=/a,jobs=0"), HasSubstr("jobs is '0'"));
  EXPECT_THAT(refusal_of("big:folder=/a,sbatch=-p short"), HasSubstr("long option of sbatch"));
  EXPECT_THAT(refusal_of("big:folder=/a,sbatch=--clusters=b"), HasSubstr("the daemon itself decides"));
}

TEST(Packing, FillsTasksUpToTheirLengthInOrder) {
  const std::vector<Need> needs = {{1, 256, 20.0}, {1, 256, 30.0}, {1, 256, 20.0}, {2, 256, 5.0}, {1, 256, 100.0}};
  const auto packs = pack(needs, seconds(60), 1000);
  ASSERT_EQ(packs.size(), 2U);
  EXPECT_THAT(packs[0].tasks, ElementsAre(Share{0, 1}, Share{2}, Share{4}));
  EXPECT_EQ(packs[0].need, (Need{1, 256, 100.0}));
  EXPECT_THAT(packs[1].tasks, ElementsAre(Share{3}));
  EXPECT_EQ(packs[1].need.threads, 2);
}

TEST(Packing, KeepsToTheMostTasksOfAnArray) {
  const std::vector<Need> needs(7, Need{1, 256, 10.0});
  const auto packs = pack(needs, seconds(0), 3);
  ASSERT_EQ(packs.size(), 3U);
  EXPECT_EQ(packs[2].tasks, std::vector<Share>{Share{6}});
}

// A case that a newer version refuses takes no time.
TEST(Packing, PacksAnAttemptWithoutAPredictedTime) {
  EXPECT_EQ(pack({Need{1, 256, 0.0}}, seconds(60), 1000).size(), 1U);
  EXPECT_EQ(pack({Need{1, 256, 0.0}, Need{1, 256, 0.0}}, seconds(0), 1000).at(0).tasks.size(), 2U);
}

TEST(Packing, AsksForMoreThanIsPredicted) {
  EXPECT_EQ(need_of(2, 100 << 20, 1.0, 5.0).memory_mib, 256);
  EXPECT_EQ(need_of(2, 100 << 20, 1.5, 5.0).memory_mib, 384);
  // At first, after one and after two attempts that ran out of memory, and with a limit of the daemon.
  const auto asked = [](double factor, std::int64_t most) {
    const auto limit = [most](double of) { return translate::memory_limit(400 << 20, 1, of, most); };
    const double raised = static_cast<double>(limit(factor)) / static_cast<double>(limit(1.0));
    return need_of(1, limit(1.0), raised, 5.0).memory_mib;
  };
  EXPECT_EQ(asked(1.0, 0), 640);
  EXPECT_EQ(asked(1.5, 0), 1024);
  EXPECT_EQ(asked(2.25, 0), 1536);
  EXPECT_EQ(asked(2.25, 800 << 20), 896);
  EXPECT_EQ(asked(1.0, 450 << 20), 640);
  EXPECT_EQ(time_limit_minutes(60.0, seconds(0)), 13);
  EXPECT_EQ(time_limit_minutes(1e6, seconds(7200)), 120);
  EXPECT_EQ(time_limit_minutes(0.0, seconds(1)), 1);
}

TEST(SlurmCommands, LinesOfSqueueAreRead) {
  const auto task = parse_squeue_line("17|3|PENDING|Resources, or held|n[1-2]|cellcrush-ab|cd");
  ASSERT_TRUE(task.has_value());
  EXPECT_EQ(task->job, 17);
  EXPECT_EQ(task->task, 3);
  EXPECT_EQ(task->state, "PENDING");
  EXPECT_EQ(task->reason, "Resources, or held");
  EXPECT_EQ(task->node, "n[1-2]");
  EXPECT_EQ(task->name, "cellcrush-ab|cd");
  EXPECT_EQ(parse_squeue_line("18|N/A|RUNNING|None|n1|x")->task, -1);
  EXPECT_EQ(parse_squeue_line("18|N/A|RUNNING|None|n1|x")->reason, "");
  for (const char* broken : {"", "18", "a|b|c|d|e|f", "||||||", "slurm_load_jobs error: x|y|z|a|b|c"})
    EXPECT_FALSE(parse_squeue_line(broken).has_value()) << broken;
}

TEST(SlurmCommands, LinesOfSacctAreRead) {
  const auto task = parse_sacct_line("17_3|CANCELLED by 1000|n2|cellcrush-ab");
  ASSERT_TRUE(task.has_value());
  EXPECT_EQ(task->job, 17);
  EXPECT_EQ(task->task, 3);
  EXPECT_EQ(task->state, "CANCELLED");
  EXPECT_EQ(task->reason, "by 1000");
  EXPECT_EQ(parse_sacct_line("18|COMPLETED|None assigned|x")->node, "");
  for (const char* broken : {"", "17_[3-9]|PENDING|n|x", "x|y|z|w"})
    EXPECT_FALSE(parse_sacct_line(broken).has_value()) << broken;
}

TEST(SlurmCommands, AStateWithoutAMeaningHereIsUnknown) {
  EXPECT_EQ(meaning_of("NODE_FAIL"), Meaning::displaced);
  EXPECT_EQ(meaning_of("OUT_OF_MEMORY"), Meaning::no_memory);
  EXPECT_EQ(meaning_of("TELEPORTED"), Meaning::unknown);
}

TEST(RunProgram, KillsWhatTakesTooLongWithAllItStarted) {
  const auto end = run_program({"sh", "-c", "echo said; echo failed >&2; sleep 1000 & sleep 1000"}, milliseconds(500));
  EXPECT_TRUE(end.timed_out);
  EXPECT_FALSE(end.exit_code.has_value());
  EXPECT_EQ(end.output, "said\n");
  EXPECT_EQ(end.errors, "failed\n");
}

TEST(RunProgram, ReadsALongOutputAndTheExitCode) {
  const auto end = run_program({"sh", "-c", "head -c 3000000 /dev/zero; exit 7"}, seconds(20));
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_EQ(end.output.size(), 3'000'000U);
  // A process left behind keeps the pipes open.
  EXPECT_EQ(run_program({"sh", "-c", "sleep 5 & echo done"}, seconds(20)).output, "done\n");
  EXPECT_THROW(run_program({"/nowhere/sbatch"}, seconds(1)), std::system_error);
}

TEST(AttemptClaim, IsTakenByOneOfMany) {
  const testing::TemporaryFolder temporary;
  const AttemptFolder folder(temporary.path() / "attempts" / "a");
  fs::create_directories(folder.root());
  std::atomic<int> winners = 0;
  {
    std::vector<std::jthread> claimants;
    for (int i = 0; i < 16; ++i) {
      claimants.emplace_back([&, i] {
        Claim claim;
        claim.set_host("host");
        claim.set_process(i);
        if (folder.claim(claim)) ++winners;
      });
    }
  }
  EXPECT_EQ(winners, 1);
  EXPECT_TRUE(folder.find_claim().has_value());
}

TEST(AttemptClaim, CannotBeTakenOnceTheFolderIsGone) {
  const testing::TemporaryFolder temporary;
  const AttemptFolder folder(temporary.path() / "attempts" / "a");
  fs::create_directory(temporary.path() / "attempts");
  EXPECT_THROW(static_cast<void>(folder.requested()), ServiceError) << "Its file system may not be mounted.";
  write_small_file(temporary.path() / kMarker, "x");
  EXPECT_FALSE(folder.claim(Claim()));
  EXPECT_EQ(folder.requested(), Request::ABANDON);
  EXPECT_FALSE(folder.find_ended().has_value());
}

TEST(ScratchFolder, OfAKilledTaskIsRemovedByTheNextOneAndThatOfALivingOneIsNot) {
  const testing::TemporaryFolder temporary;
  const auto count = [&] { return std::distance(fs::directory_iterator(temporary.path()), fs::directory_iterator()); };
  {
    const ScratchFolder alive(temporary.path());
    write_small_file(alive.path() / "reports", "text");
    const pid_t other = fork();
    if (other == 0) {
      const ScratchFolder left(temporary.path());
      write_small_file(left.path() / "reports", "text");
      raise(SIGKILL);
    }
    ASSERT_EQ(waitpid(other, nullptr, 0), other);
    EXPECT_EQ(count(), 2);
    {
      const ScratchFolder next(temporary.path());
      EXPECT_EQ(count(), 2);
      EXPECT_TRUE(fs::exists(alive.path() / "reports"));
      EXPECT_TRUE(fs::exists(next.path()));
    }
    EXPECT_EQ(count(), 1);
  }
  EXPECT_EQ(count(), 0);
}

std::string refusal_of(const ClusterOptions& options, const fs::path& data) {
  try {
    prepare_shared_folder(options, data);
    return "not refused";
  } catch (const ServiceError& error) {
    return error.what();
  }
}

TEST(SharedFolder, BelongsToOneDataFolderAndUserAndHasToBeThere) {
  const testing::TemporaryFolder temporary;
  ClusterOptions options;
  options.name = "big";
  options.folder = temporary.path() / "shared";
  fs::create_directory(options.folder);
  const fs::path data = temporary.path() / "data";
  EXPECT_NO_THROW(prepare_shared_folder(options, data));
  EXPECT_NO_THROW(prepare_shared_folder(options, data));
  EXPECT_THROW(prepare_shared_folder(options, temporary.path() / "other"), ServiceError);
  const auto attempts = options.folder / "attempts";
  const auto foreign = temporary.path() / "foreign" / "thesis";
  fs::create_directories(foreign);
  fs::create_directory(attempts / "0123456789abcdef");
  fs::create_directory(attempts / "thesis");
  fs::create_directory_symlink(foreign.parent_path(), attempts / "0123456789abcdee");
  prepare_shared_folder(options, data);
  EXPECT_FALSE(fs::exists(attempts / "0123456789abcdef"));
  EXPECT_TRUE(fs::exists(attempts / "thesis"));
  EXPECT_TRUE(fs::exists(attempts / "0123456789abcdee" / "thesis"));
  fs::remove_all(attempts);
  fs::create_directory_symlink(foreign.parent_path(), attempts);
  EXPECT_THAT(refusal_of(options, data), HasSubstr("is a symbolic link"));
  EXPECT_TRUE(fs::exists(foreign));
  fs::remove(attempts);
  chmod(options.folder.c_str(), 0777);
  EXPECT_THAT(refusal_of(options, data), HasSubstr("has mode 0777: users other than its owner can write in it. Run "
                                                   "chmod go-w " +
                                                   options.folder.string()));
  chmod(options.folder.c_str(), 0755);
  if (geteuid() == 0) {
    ASSERT_EQ(chown(options.folder.c_str(), 1234, 1234), 0);
    EXPECT_THAT(refusal_of(options, data), HasSubstr("belongs to another user (uid 1234)"));
    ASSERT_EQ(chown(options.folder.c_str(), 0, 0), 0);
  }
  // As when its file system is not mounted.
  fs::remove_all(options.folder);
  fs::create_directory(options.folder);
  EXPECT_THROW(prepare_shared_folder(options, data), ServiceError);
  EXPECT_THROW(require_marker(options.folder), ServiceError);
  EXPECT_TRUE(fs::is_empty(options.folder));
}

// Files of 8 GB, links and FIFOs in the place of what a task writes.
TEST(AttemptFiles, NoFileOfAnotherKindIsReadFollowedOrWaitedFor) {
  const testing::TemporaryFolder temporary;
  const AttemptFolder folder(temporary.path() / "attempts" / "a");
  fs::create_directories(folder.root());
  write_small_file(temporary.path() / kMarker, "x");
  folder.beat(1);
  fs::rename(folder.root() / "heartbeat", temporary.path() / "heartbeat");
  const auto expect_absent = [&] {
    rusage before{};
    rusage after{};
    getrusage(RUSAGE_SELF, &before);
    EXPECT_FALSE(folder.find_claim() || folder.last_beat() || folder.find_ended());
    EXPECT_EQ(folder.requested(), Request::NONE);
    getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss, before.ru_maxrss + 100'000) << "in kB";
  };
  for (const char* name : {"claim", "heartbeat", "ended", "request"}) {
    std::ofstream(folder.root() / name).close();
    fs::resize_file(folder.root() / name, std::uintmax_t{8} << 30);
  }
  expect_absent();
  for (const char* name : {"claim", "heartbeat", "ended", "request"}) {
    fs::remove(folder.root() / name);
    fs::create_symlink(temporary.path() / "heartbeat", folder.root() / name);
  }
  expect_absent();
  EXPECT_THROW(folder.beat(2), ServiceError);
  EXPECT_EQ(read_small_file(temporary.path() / "heartbeat")->front(), '1');
  for (const char* name : {"claim", "heartbeat", "ended", "request"}) {
    fs::remove(folder.root() / name);
    mkfifo((folder.root() / name).c_str(), 0600);
  }
  expect_absent();
}

TEST(AttemptFiles, AnIdIsNoPath) {
  for (const char* id : {"", "../x", "/etc", ".."}) EXPECT_THROW(AttemptFolder("/shared", id), ServiceError) << id;
}

}  // namespace
}  // namespace cellcrush::slurm
