#include "faults/fault_fixture.h"

#include <csignal>

#include "store/data_folder.h"
#include "store/journal.h"

namespace cellcrush::testing {

Client impatient_client(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 100);
  // How long an attempt may take.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5000);
  return Client(address, arguments);
}

std::map<std::string, v1::Job> all_jobs(Client& client) {
  std::map<std::string, v1::Job> out;
  v1::ListJobsRequest request;
  request.set_page_size(1000);
  while (true) {
    v1::ListJobsResponse page;
    const auto status = client.jobs->ListJobs(bounded_context().get(), request, &page);
    EXPECT_TRUE(status.ok()) << status.error_message();
    for (const auto& job : page.jobs()) EXPECT_TRUE(out.emplace(job.name(), job).second) << job.name() << " twice";
    request.set_page_token(page.next_page_token());
    if (!status.ok() || page.next_page_token().empty()) return out;
  }
}

void fill_journal(const std::filesystem::path& data_folder, std::int64_t count, const v1::Case& submitted) {
  const store::DataFolder folder(data_folder);
  {
    store::Journal journal(folder.journal(), [](std::int64_t) {});
    v1::Job job;
    *job.mutable_case_() = submitted;
    journal.create_job(job, "", "");
  }
  // Copies of the first one: ten thousand calls of create_job would take as many waits for the disk.
  store::Database database(folder.journal());
  store::Transaction transaction(database);
  store::Statement(database,
                   "WITH RECURSIVE numbers(n) AS (SELECT 2 UNION ALL SELECT n + 1 FROM numbers WHERE n < ?1) "
                   "INSERT INTO jobs (state, job, submitted_case, last_sequence, owner, title, bytes) "
                   "SELECT state, job, submitted_case, last_sequence, owner, title, bytes FROM jobs, numbers WHERE "
                   "number = 1 AND n <= ?1")
      .bind(1, count)
      .run();
  database.execute("INSERT INTO events (job, sequence, payload) SELECT number, 1, job FROM jobs WHERE number > 1");
  transaction.commit();
}

void FaultFixture::TearDown() {
  daemon_.reset();
  kill_workers(data_folder());
}

void FaultFixture::start_daemon(const std::vector<std::string>& more_arguments) {
  begin_daemon(more_arguments);
  ASSERT_EQ(daemon_->wait_for_addresses(1).size(), 1U);
}

void FaultFixture::begin_daemon(const std::vector<std::string>& more_arguments) {
  std::vector<std::string> arguments = {"--data", data_folder().string(), "--listen", address()};
  arguments.insert(arguments.end(), more_arguments.begin(), more_arguments.end());
  daemon_ = std::make_unique<DaemonProcess>(arguments);
}

void FaultFixture::kill_daemon() {
  daemon_->send_signal(SIGKILL);
  EXPECT_EQ(daemon_->wait(), -1 - SIGKILL) << daemon_->errors();
}

std::string FaultFixture::stop_daemon() {
  daemon_->send_signal(SIGTERM);
  EXPECT_EQ(daemon_->wait(), 0) << daemon_->errors();
  return daemon_->errors();
}

}  // namespace cellcrush::testing
