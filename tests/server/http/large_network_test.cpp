// 200,000 walls, each with a thickness of its own, through both doors.
#include <gmock/gmock.h>

#include "drawing/compact_network.h"
#include "server/brick_network.h"
#include "server/http/http_fixture.h"
#include "store/hdf5.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class LargeNetworkTest : public HttpFixture {
 protected:
  // Parses the answer to a request over HTTP.
  template <class Answer, class Request>
  [[nodiscard]] Answer over_http(const std::string& method, const Request& request) const {
    const std::string answer = exchange(this->request(
        "POST /cellcrush.v1." + method, "Content-Type: application/proto\r\n", request.SerializeAsString()));
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200")) << answer.substr(0, 500);
    Answer out;
    EXPECT_TRUE(out.ParseFromString(answer.substr(answer.find("\r\n\r\n") + 4)));
    return out;
  }
};

TEST_F(LargeNetworkTest, TwoHundredThousandWallsTravelInTheCompactForm) {
  start(http_options());
  v1::Case submitted = brick_network(365, 366);
  v1::Lattice::Network& network = *submitted.mutable_lattice()->mutable_network();
  const int walls = network.walls_size() / 2;
  ASSERT_GE(walls, 199'500);
  ASSERT_LE(walls, 200'000);
  EXPECT_GT(submitted.ByteSizeLong(), 4'800'000U);
  EXPECT_FALSE(client().try_to(job_of(submitted)).ok());
  ASSERT_TRUE(drawing::make_compact(network, drawing::Rounding::none));
  EXPECT_LT(submitted.ByteSizeLong(), 3'000'000U);

  v1::CheckCaseRequest check;
  *check.mutable_case_() = submitted;
  for (const auto& checked : {answer_of(*client().cases, &v1::Cases::Stub::CheckCase, check),
                              over_http<v1::CheckCaseResponse>("Cases/CheckCase", check)}) {
    ASSERT_EQ(checked.problems_size(), 0) << checked.problems(0).ShortDebugString();
    EXPECT_EQ(checked.element_count(), walls);
    EXPECT_LT(checked.ByteSizeLong(), 3'100'000U) << "with the completed case";
    EXPECT_EQ(checked.completed_case().lattice().network().compact().SerializeAsString(),
              network.compact().SerializeAsString());
  }

  v1::PreviewCaseRequest preview;
  *preview.mutable_case_() = submitted;
  preview.mutable_case_()->set_elements_per_wall(2);
  for (const auto& previewed : {answer_of(*client().cases, &v1::Cases::Stub::PreviewCase, preview),
                                over_http<v1::PreviewCaseResponse>("Cases/PreviewCase", preview)})
    EXPECT_EQ(previewed.mesh().element_nodes_size(), 2 * walls) << "of one element each";

  const auto created = over_http<v1::Job>("Jobs/CreateJob", job_of(submitted));
  const std::string job = client().create(submitted);
  const auto watched = client().watch(created.name(), 0, true);
  ASSERT_TRUE(watched.status.ok()) << watched.status.error_message();
  const v1::Job ended = client().get(created.name());
  ASSERT_EQ(ended.state(), v1::Job::SUCCEEDED) << ended.cause_message();
  EXPECT_EQ(ended.case_().SerializeAsString(), submitted.SerializeAsString());
  EXPECT_EQ(over_http<v1::Job>("Jobs/GetJob", named<v1::GetJobRequest>(job)).case_().SerializeAsString(),
            submitted.SerializeAsString());
  EXPECT_GE(client().history(created.name()).size(), 2U);
  int frame_numbers = 0;
  for (const auto& event : watched.events) frame_numbers += event.frame().frame().position_mm_size();
  EXPECT_GE(frame_numbers, 2 * 365 * 366) << "a whole frame";

  grpc::Status status;
  const std::string bytes = client().download(created.name(), 0, status);
  EXPECT_TRUE(status.ok()) << status.error_message();
  const auto answer = exchange(request("GET /" + created.name() + "/result.h5", ""));
  EXPECT_EQ(answer.size() - answer.find("\r\n\r\n") - 4, bytes.size());
  const store::ResultReader result(data_folder() / created.name() / "result.h5");
  EXPECT_EQ(result.job().case_().SerializeAsString(), submitted.SerializeAsString())
      << "The file has all that it needs.";
  EXPECT_EQ(result.mesh().element_nodes_size(), 2 * walls);
}

}  // namespace
}  // namespace cellcrush::testing
