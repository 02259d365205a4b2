// Bytes and bits of a data folder that a disk has changed: whatever is served then is what was stored, or is said to be
// damaged; and `cellcrushd verify` names it.
#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "error.h"
#include "log_format.h"
#include "server/journal_fixture.h"
#include "server/log_capture.h"
#include "store/backup.h"
#include "store/result_writer.h"
#include "store/sweep_reader.h"
#include "store/verification.h"

namespace cellcrush::store {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

constexpr const char* kDamaged = "damaged";

// Everything that is served of a data folder, by name: its bytes, or kDamaged.
using Served = std::map<std::string, std::string>;

class DamageTest : public JournalTest {
 protected:
  // jobs/1 has ended with a result, jobs/2 runs, jobs/3 and jobs/4 are a sweep, jobs/5 is of many states.
  void SetUp() override {
    JournalTest::SetUp();
    for (const std::int64_t job : {create("first"), create()}) {
      change(job, v1::Job::RUNNING);
      journal_->set_mesh(job, mesh());
      for (int step = 1; step <= 40; ++step) add_sample(job, full_sample(step));
      journal_->commit_samples();
    }
    write_result(1);
    change(1, v1::Job::SUCCEEDED);
    fs::remove(folder_.path() / "jobs/1/reports");
    v1::Sweep sweep;
    *sweep.mutable_case_() = testing::small_case();
    const v1::Job job = reader_->find_job(1)->job;
    const auto of_sweep = [&job] {
      v1::Job out;
      *out.mutable_case_() = job.case_();
      return out;
    };
    journal_->create_sweep(sweep, {{of_sweep, {50.0}}, {of_sweep, {80.0}}}, "", "");
    const std::int64_t last = create();
    for (int i = 0; i < 30; ++i)
      journal_->set_note(last, std::string(200, static_cast<char>('a' + i % 26)),
                         i == 0 ? "" : std::string(200, static_cast<char>('a' + (i - 1) % 26)));
    close();
    // Otherwise its pages are read from the WAL.
    Database(path()).execute("PRAGMA wal_checkpoint(TRUNCATE)");
    whole_ = served(folder_.path());
  }

  void close() {
    reader_.reset();
    journal_.reset();
  }

  static v1::Mesh mesh() {
    v1::Mesh out;
    out.set_particle_count(2);
    for (const int node : {0, 1}) out.add_element_nodes(node);
    out.add_thickness_mm(0.5F);
    out.add_element_wall(0);
    out.set_length_mm(10.0);
    return out;
  }

  static v1::Sample full_sample(int step) {
    v1::Sample out = sample(step);
    out.set_time_s(1e-6 * step);
    out.set_strain(1e-3 * step);
    out.set_stress_impact_mpa(3.0 + 0.1 * step);
    return out;
  }

  void write_result(std::int64_t job) {
    const JobFolder folder(folder_.path() / name_of(job));
    ResultWriter writer(folder.result(), mesh());
    v1::FieldFrame frame;
    for (int i = 0; i < 4; ++i) frame.add_position_mm(static_cast<float>(i));
    frame.add_plastic_fraction(0.25F);
    frame.add_fibre_strain(0.01F);
    frame.add_local_strain(0.02F);
    writer.add_frame(frame);
    for (int step = 1; step <= 40; ++step) writer.add_sample(full_sample(step));
    v1::Job described = reader_->find_job(job)->job;
    described.set_state(v1::Job::SUCCEEDED);
    writer.finish({described, "1.0", "scalar", 1, 1e-7, {}});
  }

  template <typename Read>
  static void put(Served& out, const std::string& name, const Read& read) {
    try {
      out[name] = read();
    } catch (const ServiceError& error) {
      EXPECT_EQ(error.kind(), ServiceError::Kind::data_loss) << error.what();
      out[name] = kDamaged;
    }
  }

  static std::string bytes_of(const StoredJob& stored) {
    return stored.is_damaged || stored.job.cause() == v1::Job::STORE_CORRUPT ? kDamaged
                                                                             : stored.job.SerializeAsString();
  }

  static Served served(const fs::path& folder) {
    Served out;
    const auto path = folder / "journal.sqlite";
    try {
      Journal journal(path, [](std::int64_t) {});
      JournalReader reader(path);
      SweepReader sweeps(path);
      put(out, "list", [&] {
        for (const auto& stored : reader.list_jobs({}, false, 0, 100))
          out["list " + stored.job.name()] = bytes_of(stored);
        return "";
      });
      for (const std::int64_t job : {1, 2, 3, 4, 5}) {
        const std::string name = name_of(job);
        put(out, name, [&] {
          const auto stored = reader.find_job(job);
          return stored ? bytes_of(*stored) : "none";
        });
        put(out, name + " mesh", [&] {
          const auto mesh = reader.mesh(job);
          return mesh ? mesh->SerializeAsString() : kDamaged;
        });
        std::int64_t after = 0;
        put(out, name + " events", [&] {
          for (const auto& event : reader.events(job, 0, 1000)) {
            after = event.sequence();
            const bool is_corrupt = event.state().cause() == v1::Job::STORE_CORRUPT;
            out[name + " event " + std::to_string(after)] = is_corrupt ? kDamaged : event.SerializeAsString();
          }
          return reader.events(job, after, 1).empty() && after >= reader.find_job(job)->last_sequence ? "all"
                                                                                                      : kDamaged;
        });
        put(out, name + " samples", [&] {
          std::string all;
          const auto found = reader.samples(job);
          for (const auto& sample : found.samples) all += sample.SerializeAsString();
          return found.samples.size() < 40 && job < 3 ? kDamaged : all;
        });
      }
      put(out, "sweep", [&] {
        const auto sweep = sweeps.find_sweep(1);
        return sweep ? sweep->has_create_time() ? sweep->case_().SerializeAsString() : kDamaged : "none";
      });
      put(out, "table", [&] {
        std::string all;
        for (const auto& row : sweeps.rows(1).rows)
          all += row.result().cause() == v1::Job::STORE_CORRUPT ? kDamaged : row.SerializeAsString();
        return all.find(kDamaged) == std::string::npos ? all : kDamaged;
      });
      put(out, "frame", [&] { return ResultReader(folder / "jobs/1/result.h5").frame(0).SerializeAsString(); });
    } catch (const ServiceError& error) {
      EXPECT_EQ(error.kind(), ServiceError::Kind::data_loss) << error.what();
      for (auto& [name, bytes] : out) bytes = kDamaged;
      out["start"] = kDamaged;
    }
    return out;
  }

  // Damages the file at bytes that lie apart, and at single bits, one at a time. Returns how many of them `verify`
  // calls intact although something else is served, and how often something else is served without a word.
  void damage_each(const std::string& name, int in_bytes, int in_bits) {
    const testing::TemporaryFolder place;
    const auto copy = place.path() / "copy";
    const auto size = fs::file_size(folder_.path() / name);
    std::mt19937 random(7);
    int served_otherwise = 0;
    for (int i = 0; i < in_bytes + in_bits; ++i) {
      fs::remove_all(copy);
      fs::copy(folder_.path(), copy, fs::copy_options::recursive);
      const auto offset = i < in_bytes ? size * static_cast<std::uint64_t>(i) / static_cast<std::uint64_t>(in_bytes) +
                                             random() % (size / static_cast<std::uint64_t>(in_bytes))
                                       : random() % size;
      const int change = i < in_bytes ? 0xff : 1 << (random() % 8);
      flip(copy / name, offset, change);
      const bool is_intact = verifies(copy);
      const testing::LogCapture log(make_text_formatter());
      const Served now = served(copy);
      const std::string where = name + " at " + std::to_string(offset);
      const bool has_word = log.text().find("damaged") != std::string::npos;
      for (const auto& [what, bytes] : whole_) {
        const auto found = now.find(what);
        const std::string other = found == now.end() ? "none" : found->second;
        if (other == bytes) continue;
        ++served_otherwise;
        EXPECT_FALSE(is_intact) << where << ": " << what;
        EXPECT_TRUE(other == kDamaged || (other == "none" && has_word) || (found == now.end() && !is_intact))
            << where << ": " << what << " is " << other.substr(0, 60);
      }
      for (const auto& [what, bytes] : now)
        EXPECT_TRUE(whole_.contains(what) || bytes == kDamaged) << where << ": " << what << " was not there";
    }
    fs::remove_all(copy);
    std::cout << name << ": " << served_otherwise << " values of " << in_bytes + in_bits << " damages are named\n";
  }

  static bool verifies(const fs::path& folder) {
    try {
      return verify_folder(folder).problems.empty();
    } catch (const ServiceError&) {
      return false;
    }
  }

  static void flip(const fs::path& file, std::uint64_t offset, int bits) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(offset));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(offset));
    stream.put(static_cast<char>(byte ^ bits));
  }

  Served whole_;
};

TEST_F(DamageTest, NoByteOfTheJournalGivesAnotherHistoryWithoutAWord) {
  ASSERT_THAT(verify_folder(folder_.path()).problems, IsEmpty());
  damage_each("journal.sqlite", 51, 12);
}

TEST_F(DamageTest, NoByteOfReportsOrResultGivesOtherSamplesWithoutAWord) {
  damage_each("jobs/2/reports", 15, 4);
  damage_each("jobs/1/result.h5", 10, 2);
}

}  // namespace
}  // namespace cellcrush::store
