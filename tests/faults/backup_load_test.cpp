// Backups that are taken while jobs are submitted, run and deleted, and what is restored of them.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <iostream>
#include <mutex>
#include <set>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "store/backup.h"
#include "store/verification.h"

namespace cellcrush::testing {
namespace {

using ::testing::IsEmpty;

// Every case another title, by which a mixed-up job is found.
v1::Case titled_case(int index) {
  v1::Case out = tiny_case();
  out.set_title("case " + std::to_string(index));
  return out;
}

class BackupLoadTest : public FaultFixture {
 protected:
  // What was acknowledged: job by name, with its title.
  struct Acknowledged {
    std::map<std::string, std::string> jobs;
    std::set<std::string> deleted;  ///< of which the deletion was at least begun
  };

  // Submits and deletes until it is told to stop.
  void load(const std::stop_token& stop, int first) {
    auto client = this->client();
    std::string last;
    for (int i = first; !stop.stop_requested(); i += 2) {
      const auto submitted = titled_case(i);
      const std::string job = client.create(submitted);
      {
        const std::scoped_lock lock(mutex_);
        acknowledged_.jobs[job] = submitted.title();
      }
      if (!last.empty() && i % 3 == 0 && client.wait_for_state(last, v1::Job::SUCCEEDED)) {
        {
          const std::scoped_lock lock(mutex_);
          acknowledged_.deleted.insert(last);
        }
        EXPECT_TRUE(client.remove(last).ok());
      }
      last = job;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  Acknowledged acknowledged() {
    const std::scoped_lock lock(mutex_);
    return acknowledged_;
  }

  // The bytes of every result, by job, as they are now.
  static std::map<std::string, std::string> results_of(Client& client) {
    std::map<std::string, std::string> out;
    for (const auto& [name, job] : all_jobs(client)) {
      grpc::Status status;
      if (job.has_summary()) out[name] = client.download(name, 0, status);
    }
    return out;
  }

  std::mutex mutex_;
  Acknowledged acknowledged_;
};

TEST_F(BackupLoadTest, AllThatWasAcknowledgedBeforeABackupIsInItAndNoneIsMixed) {
  const int count = rounds(3, 12);
  start_daemon({"--workers", "2"});
  std::vector<Acknowledged> before;
  std::vector<Acknowledged> after;
  {
    std::jthread first([this](const std::stop_token& stop) { load(stop, 0); });
    std::jthread second([this](const std::stop_token& stop) { load(stop, 1); });
    for (int i = 0; i < count; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1500));
      before.push_back(acknowledged());
      store::take_backup(data_folder(), folder_.path() / ("backup" + std::to_string(i)));
      after.push_back(acknowledged());
    }
  }
  auto live = this->client();
  for (const auto& [name, title] : acknowledged().jobs)
    EXPECT_TRUE(acknowledged().deleted.contains(name) || live.wait_for_state(name, v1::Job::SUCCEEDED));
  const auto results = results_of(live);
  const auto reference = numbers_of(live, data_folder(), results.begin()->first);
  stop_daemon();
  std::size_t jobs = 0;
  for (int i = 0; i < count; ++i) {
    const auto backup = folder_.path() / ("backup" + std::to_string(i));
    EXPECT_THAT(store::verify_folder(backup).problems, IsEmpty());
    EXPECT_THAT(store::verify_folder(backup).notes, IsEmpty());
    std::filesystem::remove_all(data_folder());
    store::restore_backup(backup, data_folder());
    start_daemon({"--workers", "2"});
    auto client = this->client();
    const auto restored = all_jobs(client);
    jobs += restored.size();
    for (const auto& [name, title] : before[i].jobs)
      EXPECT_TRUE(after[i].deleted.contains(name) || restored.contains(name)) << name << " of backup " << i;
    for (const auto& [name, job] : restored) EXPECT_EQ(job.case_().title(), acknowledged().jobs.at(name)) << name;
    for (const auto& [name, bytes] : results_of(client))
      EXPECT_TRUE(!results.contains(name) || restored.at(name).state() != v1::Job::SUCCEEDED ||
                  bytes == results.at(name))
          << name;
    for (const auto& [name, job] : restored) {
      ASSERT_TRUE(client.wait_for_state(name, v1::Job::SUCCEEDED)) << name;
      EXPECT_EQ(client.history(name).size(), 21U) << name;
    }
    EXPECT_TRUE(numbers_of(client, data_folder(), restored.rbegin()->first) == reference);
    stop_daemon();
  }
  std::cout << count << " backups under load, " << jobs << " jobs restored: none lost, none mixed\n";
}

}  // namespace
}  // namespace cellcrush::testing
