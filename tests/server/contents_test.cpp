// Lattices and meshes that many jobs have are in the journal once, and are whole or named.
#include <gmock/gmock.h>

#include <fstream>

#include "error.h"
#include "server/brick_network.h"
#include "server/journal_fixture.h"
#include "store/backup.h"
#include "store/lattice_file.h"
#include "store/sweep_reader.h"
#include "store/verification.h"

namespace cellcrush::store {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

namespace fs = std::filesystem;

class ContentsTest : public JournalTest {
 protected:
  static constexpr int kPoints = 100;

  static v1::Case case_at(double speed) {
    static const v1::Case kBase = testing::brick_network(120, 100);
    v1::Case out = kBase;
    out.mutable_loading()->set_speed_m_per_s(speed);
    return out;
  }

  Journal::CreatedSweep create_sweep() {
    v1::Sweep sweep;
    *sweep.mutable_case_() = case_at(1.0);
    std::vector<SweepJob> jobs(kPoints);
    for (int i = 0; i < kPoints; ++i) {
      jobs[i].job = [i] {
        v1::Job out;
        *out.mutable_case_() = case_at(1.0 + i);
        return out;
      };
      jobs[i].values = {1.0 + i};
    }
    return journal_->create_sweep(sweep, jobs, "", "");
  }

  static v1::Mesh mesh() {
    v1::Mesh out;
    for (int i = 0; i < 6000; ++i) out.add_element_nodes(i % 70);
    return out;
  }

  // Of a connection that keeps no rules.
  void damage(const std::string& sql) {
    Database raw(path());
    raw.execute("PRAGMA foreign_keys = OFF");
    raw.execute(sql.c_str());
  }

  [[nodiscard]] std::int64_t count(const std::string& what) {
    Database raw(path());
    return Statement(raw, "SELECT " + what).number();
  }

  [[nodiscard]] std::vector<std::string> problems() const { return verify_folder(folder_.path()).problems; }
};

TEST_F(ContentsTest, ASweepKeepsTheLatticeOfItsJobsOnce) {
  const auto made = create_sweep();
  const auto size = static_cast<std::int64_t>(case_at(1.0).ByteSizeLong());
  EXPECT_EQ(count("COUNT(*) FROM contents"), 1);
  EXPECT_LT(count("SUM(LENGTH(submitted_case)) FROM jobs"), kPoints * 500);
  reader_.reset();
  journal_.reset();
  Database(path()).execute("PRAGMA wal_checkpoint(TRUNCATE)");
  EXPECT_LT(static_cast<std::int64_t>(fs::file_size(path())), 4 * size) << "100 copies otherwise.";
  reopen();
  for (int i = 0; i < kPoints; i += 33)
    EXPECT_EQ(reader_->find_job(made.jobs[i])->job.case_().SerializeAsString(), case_at(1.0 + i).SerializeAsString());
  EXPECT_EQ(SweepReader(path()).find_sweep(made.sweep)->case_().SerializeAsString(), case_at(1.0).SerializeAsString());
  EXPECT_GT(reader_->bytes_of_owner(""), kPoints * size) << "Each job counts all that it has.";
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(ContentsTest, ALatticeIsForgottenWithTheLastThatHasIt) {
  const auto made = create_sweep();
  const std::int64_t alone = journal_->create_job(reader_->find_job(made.jobs[7])->job, "", "").job;
  journal_->cancel_waiting(made.jobs);
  for (const std::int64_t job : made.jobs) journal_->delete_job(job);
  journal_->begin_sweep_deletion(made.sweep);
  journal_->end_sweep_deletion(made.sweep);
  EXPECT_EQ(count("COUNT(*) FROM contents"), 1);
  EXPECT_TRUE(reader_->find_job(alone)->job.case_().lattice().has_network());
  change(alone, v1::Job::CANCELLED);
  journal_->delete_job(alone);
  EXPECT_EQ(count("COUNT(*) FROM contents"), 0);
}

TEST_F(ContentsTest, AMeshThatManyJobsHaveIsKeptOnceToo) {
  const std::int64_t first = create();
  const std::int64_t second = create();
  for (const std::int64_t job : {first, second, first}) journal_->set_mesh(job, mesh());
  EXPECT_EQ(count("COUNT(*) FROM contents"), 1);
  EXPECT_EQ(reader_->mesh(second)->SerializeAsString(), mesh().SerializeAsString());
  v1::Mesh other = mesh();
  other.set_length_mm(2.0);
  journal_->set_mesh(first, other);
  EXPECT_EQ(count("COUNT(*) FROM contents"), 2);
  change(second, v1::Job::RUNNING);
  journal_->begin_again(second, "Because.");
  EXPECT_EQ(count("COUNT(*) FROM contents"), 1);
  EXPECT_EQ(reader_->mesh(first)->length_mm(), 2.0);
}

TEST_F(ContentsTest, AMissingLatticeIsNamedAndEndsTheJob) {
  const auto made = create_sweep();
  change(made.jobs[0], v1::Job::CANCELLED);
  damage("DELETE FROM contents");
  reader_.emplace(path());
  EXPECT_FALSE(reader_->find_job(made.jobs[1])->has_case);
  EXPECT_FALSE(reader_->find_job(made.jobs[1])->is_damaged);
  EXPECT_THAT(problems(), Not(IsEmpty()));
  EXPECT_THAT(problems().front(), HasSubstr("refers to a missing row of contents"));
  EXPECT_THAT(SweepReader(path()).find_sweep(made.sweep)->case_().lattice().network().joints_mm(), IsEmpty());
  reopen();
  EXPECT_EQ(reader_->find_job(made.jobs[1])->job.cause(), v1::Job::STORE_CORRUPT);
  EXPECT_EQ(reader_->find_job(made.jobs[0])->job.state(), v1::Job::CANCELLED);
}

TEST_F(ContentsTest, ADamagedLatticeIsNamedUntilACaseBringsItAgain) {
  const auto made = create_sweep();
  damage("UPDATE contents SET bytes = CAST(substr(bytes, 1, 999) || x'ff' || substr(bytes, 1001) AS BLOB)");
  reader_.emplace(path());
  EXPECT_FALSE(reader_->find_job(made.jobs[1])->has_case);
  EXPECT_THAT(problems(), Each(HasSubstr("cannot be read")));
  EXPECT_THAT(problems(), SizeIs(kPoints + 1)) << "all jobs and the sweep";
  v1::Job again;
  *again.mutable_case_() = case_at(1.0);
  journal_->create_job(again, "", "");
  EXPECT_THAT(problems(), IsEmpty());
  EXPECT_TRUE(reader_->find_job(made.jobs[1])->has_case);
}

TEST_F(ContentsTest, ABackupHasTheLatticeOnce) {
  const auto made = create_sweep();
  const auto backup = folder_.path() / "backup";
  const auto restored = folder_.path() / "restored";
  EXPECT_THAT(take_backup(folder_.path(), backup).lost, IsEmpty());
  restore_backup(backup, restored);
  EXPECT_THAT(verify_folder(restored).problems, IsEmpty());
  JournalReader reader(restored / "journal.sqlite");
  EXPECT_EQ(reader.find_job(made.jobs[5])->job.case_().SerializeAsString(), case_at(6.0).SerializeAsString());
}

class LatticeFileTest : public ::testing::Test {
 protected:
  [[nodiscard]] JobFolder folder(int job) const {
    const JobFolder out(temporary_.path() / "jobs" / std::to_string(job));
    fs::create_directories(out.root());
    return out;
  }

  static worker::Order order() {
    worker::Order out;
    out.set_job("jobs/1");
    *out.mutable_case_() = testing::brick_network(60, 50);
    return out;
  }

  static std::string refusal_of(const JobFolder& folder, worker::Order order) {
    try {
      read_lattice_of(folder, order);
    } catch (const ServiceError& error) {
      EXPECT_EQ(error.kind(), ServiceError::Kind::data_loss);
      return error.what();
    }
    return "";
  }

  testing::TemporaryFolder temporary_;
};

TEST_F(LatticeFileTest, FoldersShareTheFileOfALattice) {
  worker::Order stored;
  for (const int job : {1, 2, 3}) stored = put_lattice_apart(folder(job), order());
  EXPECT_LT(stored.ByteSizeLong(), 1000U);
  EXPECT_EQ(fs::hard_link_count(folder(1).lattice()), 4U) << "of three folders and the shared name";
  worker::Order read = stored;
  read_lattice_of(folder(2), read);
  read.clear_lattice();
  EXPECT_EQ(read.SerializeAsString(), order().SerializeAsString());
  EXPECT_EQ(put_lattice_apart(folder(2), stored).SerializeAsString(), stored.SerializeAsString());
  remove_unused_lattices(folder(1).lattices());
  EXPECT_EQ(fs::hard_link_count(folder(1).lattice()), 4U);
  fs::remove_all(temporary_.path() / "jobs");
  remove_unused_lattices(folder(1).lattices());
  EXPECT_TRUE(fs::is_empty(folder(1).lattices()));
}

TEST_F(LatticeFileTest, AMissingOrDamagedFileIsNamedAndMadeAnewByTheNextJob) {
  const worker::Order stored = put_lattice_apart(folder(1), order());
  const auto shared = folder(1).lattices() / stored.lattice();
  {
    std::fstream file(shared, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(5000);
    file.put('\x7f').put('\x01');
  }
  EXPECT_THAT(refusal_of(folder(1), stored), HasSubstr("lattice in the folder of jobs/1 is damaged"));
  put_lattice_apart(folder(2), order());
  EXPECT_EQ(refusal_of(folder(2), stored), "");
  put_lattice_apart(folder(3), order());
  EXPECT_TRUE(fs::equivalent(folder(2).lattice(), folder(3).lattice()));
  fs::remove(folder(2).lattice());
  EXPECT_THAT(refusal_of(folder(2), stored), HasSubstr("is missing"));
}

TEST_F(LatticeFileTest, ASmallLatticeStaysInTheOrder) {
  worker::Order small = order();
  *small.mutable_case_() = testing::small_case();
  EXPECT_EQ(put_lattice_apart(folder(1), small).SerializeAsString(), small.SerializeAsString());
  EXPECT_FALSE(fs::exists(folder(1).lattice()));
}

}  // namespace
}  // namespace cellcrush::store
