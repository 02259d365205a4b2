// What the calls have in common: how errors are told, limits and sources of streams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <new>
#include <optional>

#include "cellcrush/v1/jobs_service.pb.h"
#include "error.h"
#include "error_table.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "programs/temporary_folder.h"
#include "rpc/export_source.h"
#include "rpc/source_stream.h"
#include "rpc/stream_limits.h"
#include "server/daemon_process.h"
#include "server/held_point.h"
#include "server/refuses.h"
#include "server/small_case.h"
#include "store/journal.h"
#include "store/resource_name.h"

namespace cellcrush::rpc {
namespace {

using ::testing::HasSubstr;
using Batch = MessageStream::Batch;
using Problems = google::protobuf::RepeatedPtrField<v1::Problem>;
using testing::Refuses;
using testing::wait_until;

void add(Problems& problems, const std::string& field) {
  auto& problem = *problems.Add();
  problem.set_field(field);
  problem.set_message("is wrong.");
  problem.set_remedy("Mend it.");
  problem.set_kind(v1::Problem::INVALID);
}

v1::ProblemList listed(const grpc::Status& status) {
  google::rpc::Status details;
  EXPECT_TRUE(details.ParseFromString(status.error_details()));
  EXPECT_EQ(details.code(), status.error_code());
  EXPECT_EQ(details.details_size(), 2);
  google::rpc::BadRequest bad_request;
  EXPECT_TRUE(details.details(0).UnpackTo(&bad_request));
  v1::ProblemList list;
  EXPECT_TRUE(details.details(1).UnpackTo(&list));
  EXPECT_EQ(bad_request.field_violations_size(), list.problems_size());
  return list;
}

TEST(ErrorTable, ManyProblemsFitIntoATrailerAndSayThatThereAreMore) {
  Problems problems;
  for (int i = 0; i < 500; ++i) add(problems, "lattice.frame.nodes[" + std::to_string(i) + "].x_mm");
  const auto status = status_of(problems);
  EXPECT_LT(status.error_details().size() * 4 / 3 + status.error_message().size(), 7500U);
  const auto list = listed(status);
  EXPECT_GT(list.problems_size(), 10);
  const auto& note = list.problems(list.problems_size() - 1);
  EXPECT_THAT(note.message(), HasSubstr(std::to_string(500 - (list.problems_size() - 1))));
  EXPECT_THAT(note.remedy(), HasSubstr("CheckCase"));
}

// One try a problem that does not fit, each of all that are left, would take hours.
TEST(ErrorTable, AHundredThousandProblemsAreAnsweredAsManyAre) {
  Problems problems;
  for (int i = 0; i < 100'000; ++i) add(problems, "axes[0].linear");
  const auto list = listed(status_of(problems, "sweep"));
  EXPECT_GT(list.problems_size(), 10);
  EXPECT_LT(list.problems_size(), 100);
}

TEST(ErrorTable, AHugeValueIsCut) {
  Problems problems;
  add(problems, "title");
  problems[0].set_value(std::string(100'000, 'x'));
  EXPECT_LT(status_of(problems).error_details().size(), 5000U);
}

TEST(ErrorTable, AFaultOfTheDaemonIsInternalAndWantOfMemoryExhausted) {
  EXPECT_EQ(status_of(ServiceError(ServiceError::Kind::internal, "why")).error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(status_of(std::bad_alloc()).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST(StreamLimits, BoundTheBytesThatNobodyHasRead) {
  StreamLimits limits({10, 10, 1000});
  auto first = limits.admit("anna");
  first.hold(5000);  // one alone may have its message
  auto second = limits.admit("bob");
  EXPECT_THAT([&] { second.hold(1); }, Refuses(ServiceError::Kind::exhausted, "--max-call-memory"));
  first.hold(900);
  EXPECT_NO_THROW(second.hold(100));
  EXPECT_THAT([&] { second.hold(101); }, Refuses(ServiceError::Kind::exhausted, "--max-call-memory"));
  EXPECT_NO_THROW(second.hold(100)) << "What was refused is not counted.";
  first.hold(400);
  auto third = limits.admit("anna");
  EXPECT_THAT([&] { third.hold(101); }, Refuses(ServiceError::Kind::exhausted, "Open streams of anna hold 400 bytes"));
  EXPECT_NO_THROW(second.hold(600)) << "Others have the other half.";
}

/// What the test sees of a source of a thousand messages, of which the first is held.
struct Tap {
  testing::HeldPoint first;
  std::atomic<int> given = 0;
  std::atomic<bool> is_open = false;
};

class TapSource {
 public:
  using Message = v1::DownloadResultResponse;
  static constexpr bool kIsWatch = true;

  explicit TapSource(Tap& tap) : tap_(tap) {}
  void open(const std::function<void()>&) { tap_.is_open = true; }
  void close() { tap_.is_open = false; }
  std::optional<Message> next() {
    tap_.first.stand();
    ++tap_.given;
    return Message();
  }
  [[nodiscard]] bool has_more() const { return false; }
  [[nodiscard]] bool ended() const { return tap_.given == 1000; }
  [[nodiscard]] Message bookmark() const { return {}; }
  [[nodiscard]] std::string resume_advice() const { return ""; }

 private:
  Tap& tap_;
};

TEST(SourceStream, CancellingWaitsForNoBatchThatIsBeingMade) {
  Tap tap;
  metrics::Metrics metrics;
  StreamLimits limits({10, 2, 100'000'000});
  watch::Pump pump(2);
  Accounts memory({1 << 20, 1 << 20});
  CallPool checks({1, 1, 1, 1, 1}, memory);
  const auto stream = std::make_shared<SourceStream<TapSource>>(
      StreamParts{pump, checks, metrics, limits, {}}, "anna",
      [](const google::protobuf::Message& each, std::string& to) { to += each.SerializeAsString(); },
      [&tap] { return std::make_unique<TapSource>(tap); });
  auto promise = std::make_shared<std::promise<Batch>>();
  auto batch = promise->get_future();
  stream->ask([promise = std::move(promise)](Batch made) { promise->set_value(std::move(made)); });
  ASSERT_TRUE(tap.first.wait());
  stream->cancel();
  tap.first.open();
  EXPECT_TRUE(wait_until([&] { return !tap.is_open && limits.count() == 0; }));
  EXPECT_EQ(tap.given, 1) << "The rest of the batch was not made.";
  EXPECT_THROW(batch.get(), std::future_error) << "Nothing was delivered.";
}

TEST(ExportSource, AJobThatIsDeletedMeanwhileIsAnErrorNotAFileWithoutItsResults) {
  const testing::TemporaryFolder folder;
  const store::DataFolder data(folder.path() / "data");
  store::Journal journal(data.journal(), [](std::int64_t) {});
  store::JournalReader reader(data.journal());
  jobs::MeshPlaces places;
  v1::Job created;
  *created.mutable_case_() = testing::small_case();
  const std::int64_t job = journal.create_job(created, "", "").job;
  store::StateChange change;
  for (const auto state : {v1::Job::RUNNING, v1::Job::FAILED}) {
    change.state = state;
    journal.change_state(job, change);
  }
  v1::ExportJobRequest request;
  request.set_name(store::name_of(job));
  const auto stored = reader.find_job(job);
  ASSERT_TRUE(stored);
  const auto call = std::make_shared<Preparation>("anna");
  {
    ExportSource whole({data, reader, places}, *stored, request);
    whole.prepare(*call);
    while (!whole.ended()) ASSERT_TRUE(whole.next());
  }
  ExportSource source({data, reader, places}, *stored, request);
  source.prepare(*call);
  ASSERT_TRUE(source.next()) << "the head";
  journal.delete_job(job);
  EXPECT_THAT(
      [&] {
        while (!source.ended()) source.next();
      },
      Refuses(ServiceError::Kind::not_found, "was deleted while it was exported"));
}

}  // namespace
}  // namespace cellcrush::rpc
