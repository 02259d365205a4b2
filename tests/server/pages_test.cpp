// No answer is larger than what a client of gRPC takes by default, 4 MiB: those of these tests are such clients.
#include <gmock/gmock.h>

#include <iostream>

#include "server/daemon_fixture.h"
#include "server/sample_writer.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "store/data_folder.h"
#include "store/journal.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::size_t kClientsLimit = 4 * 1024 * 1024;

// A sample with all of what every sample has.
v1::Sample full_sample(int step) {
  v1::Sample out;
  const auto* fields = v1::Sample::descriptor();
  for (int i = 0; i < fields->field_count(); ++i) {
    const auto* field = fields->field(i);
    if (!field->is_repeated() && field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE)
      v1::Sample::GetReflection()->SetDouble(&out, field, 0.1 * step);
  }
  out.set_step(step);
  return out;
}

// A job as it is when it has ended well, with every figure of its summary.
v1::Job full_job() {
  v1::Job out;
  out.set_state(v1::Job::SUCCEEDED);
  auto& summary = *out.mutable_summary();
  for (google::protobuf::Message* part : {static_cast<google::protobuf::Message*>(&summary),
                                          static_cast<google::protobuf::Message*>(summary.mutable_theory()),
                                          static_cast<google::protobuf::Message*>(summary.mutable_front()),
                                          static_cast<google::protobuf::Message*>(summary.mutable_quasi_static()),
                                          static_cast<google::protobuf::Message*>(summary.mutable_ledger()),
                                          static_cast<google::protobuf::Message*>(summary.mutable_stage_times())}) {
    for (int i = 0; i < part->GetDescriptor()->field_count(); ++i) {
      const auto* field = part->GetDescriptor()->field(i);
      if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE)
        part->GetReflection()->SetDouble(part, field, 0.1);
    }
  }
  for (auto* time : {out.mutable_create_time(), out.mutable_start_time(), out.mutable_end_time()})
    time->set_seconds(1'700'000'000);
  return out;
}

class PagesTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  [[nodiscard]] std::filesystem::path journal() const { return store::DataFolder(data_folder()).journal(); }

  // A job that was cancelled, with so many samples.
  void write_history(int count) const {
    store::Journal journal(this->journal(), [](std::int64_t) {});
    v1::Job job;
    *job.mutable_case_() = small_case();
    const auto number = journal.create_job(job, "", "").job;
    SampleWriter reported(data_folder());
    for (int i = 1; i <= count; ++i) reported.add(journal, number, full_sample(i));
    store::StateChange cancelled;
    cancelled.state = v1::Job::CANCELLED;
    journal.change_state(number, cancelled);
  }

  // A sweep over so many speeds, of which all jobs have ended.
  void write_sweep(int count) const {
    {
      store::Journal journal(this->journal(), [](std::int64_t) {});
      const auto sweep = sweep_of(small_case(), kSpeed, std::vector<double>(1, 50.0)).sweep();
      std::vector<store::SweepJob> jobs(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < jobs.size(); ++i) {
        jobs[i].job = small_job;
        jobs[i].values = {50.0 + static_cast<double>(i)};
      }
      journal.create_sweep(sweep, jobs, "", "");
    }
    store::Database database(journal());
    store::Statement(database, "UPDATE jobs SET state = ?1, job = ?2")
        .bind(1, v1::Job::SUCCEEDED)
        .bind_blob(2, full_job().SerializeAsString())
        .run();
  }
};

TEST_F(PagesTest, AHistoryOfSeventyThousandSamplesComesInPages) {
  constexpr int kCount = 70'000;
  write_history(kCount);
  start();
  auto client = this->client();
  auto request = named<v1::GetHistoryRequest>("jobs/1");
  v1::GetHistoryResponse page;
  std::size_t bytes = 0;
  int pages = 0;
  int step = 0;
  do {
    request.set_page_token(page.next_page_token());
    const auto status = client.jobs->GetHistory(bounded_context().get(), request, &page);
    ASSERT_TRUE(status.ok()) << status.error_message();
    ++pages;
    bytes += page.ByteSizeLong();
    EXPECT_LT(page.ByteSizeLong(), kClientsLimit);
    for (const auto& sample : page.samples()) ASSERT_EQ(sample.step(), ++step) << "None twice, none missing.";
  } while (!page.next_page_token().empty());
  EXPECT_EQ(step, kCount);
  EXPECT_GT(bytes, kClientsLimit) << "One message would not do.";
  std::cout << kCount << " samples: " << bytes << " bytes in " << pages << " pages\n";
  EXPECT_EQ(client.history("jobs/1").size(), static_cast<std::size_t>(kCount));
}

TEST_F(PagesTest, AHistorysPageIsAsLongAsAskedForAndItsTokenIsOfOneJob) {
  write_history(5);
  write_history(5);
  start();
  auto client = this->client();
  auto request = named<v1::GetHistoryRequest>("jobs/1");
  request.set_page_size(2);
  v1::GetHistoryResponse page;
  const auto steps = [&] {
    const auto status = client.jobs->GetHistory(bounded_context().get(), request, &page);
    EXPECT_TRUE(status.ok()) << status.error_message();
    std::vector<std::int64_t> out;
    for (const auto& sample : page.samples()) out.push_back(sample.step());
    request.set_page_token(page.next_page_token());
    return out;
  };
  EXPECT_THAT(steps(), ElementsAre(1, 2));
  const std::string token = page.next_page_token();
  EXPECT_THAT(steps(), ElementsAre(3, 4));
  EXPECT_THAT(steps(), ElementsAre(5));
  EXPECT_THAT(page.next_page_token(), IsEmpty());
  const auto refused = [&](const std::string& words) {
    const auto status = client.jobs->GetHistory(bounded_context().get(), request, &page);
    EXPECT_THAT(status, Fails(grpc::StatusCode::INVALID_ARGUMENT, words));
  };
  request.set_page_size(-1);
  refused("page_size is negative.");
  request.set_page_size(2);
  request.set_name("jobs/2");
  request.set_page_token(token);
  refused("page_token is not a token of this list.");
}

TEST_F(PagesTest, TheTableOfTheLargestSweepComesInPagesThatMergeIntoOne) {
  constexpr int kCount = 100'000;
  write_sweep(kCount);
  start();
  auto client = this->client();
  auto request = named<v1::GetSweepTableRequest>("sweeps/1");
  v1::SweepTable all;
  int pages = 0;
  do {
    request.set_page_token(all.next_page_token());
    const auto page = answer_of(*client.sweeps, &v1::Sweeps::Stub::GetSweepTable, request);
    ASSERT_GT(page.rows_size(), 0);
    EXPECT_LT(page.ByteSizeLong(), kClientsLimit);
    ++pages;
    all.clear_next_page_token();
    all.MergeFrom(page);
  } while (!all.next_page_token().empty());
  EXPECT_THAT(all.fields(), ElementsAre(kSpeed));
  ASSERT_EQ(all.rows_size(), kCount);
  for (int i = 0; i < kCount; ++i) ASSERT_EQ(all.rows(i).values(0), 50.0 + i);
  std::cout << kCount << " rows: " << all.ByteSizeLong() << " bytes in " << pages << " pages\n";
  const auto sweep = get_sweep(client, "sweeps/1");
  EXPECT_EQ(sweep.jobs_size(), kCount);
  std::cout << "the sweep itself: " << sweep.ByteSizeLong() << " bytes\n";
  EXPECT_LT(sweep.ByteSizeLong(), kClientsLimit);
}

// What is refused is refused before anything is computed of it.
TEST_F(PagesTest, ACaseOrASweepThatCouldNotBeToldOfIsRefused) {
  start();
  auto client = this->client();
  auto create = job_of(small_case());
  create.mutable_case_()->set_title(std::string(4'000'001, 'x'));
  auto status = client.try_to(create);
  EXPECT_THAT(status, Fails(grpc::StatusCode::INVALID_ARGUMENT, "bytes. Use at most 4000000."));
  v1::CreateSweepRequest request;
  *request.mutable_sweep()->mutable_case_() = small_case();
  (*request.mutable_sweep()->add_points()->mutable_fields())[kSpeed] = 50.0;
  (*request.mutable_sweep()->mutable_labels())["a"] = std::string(4'000'000, 'x');
  status = client.try_to(request);
  EXPECT_THAT(status, Fails(grpc::StatusCode::INVALID_ARGUMENT, "sweep has 4000"));
}

}  // namespace
}  // namespace cellcrush::testing
