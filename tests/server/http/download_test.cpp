// Files that a GET makes, for spreadsheets and notebooks.
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>

#include "cellcrush/v1/jobs_service.pb.h"
#include "server/http/http_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string lower_case(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

std::string body_of(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }

class HttpDownloadTest : public HttpFixture {
 protected:
  void SetUp() override {
    HttpFixture::SetUp();
    start(http_options());
  }

  [[nodiscard]] std::string get(const std::string& path, const std::string& headers = "") const {
    return exchange(request("GET " + path, headers));
  }
};

TEST_F(HttpDownloadTest, AHistoryIsCsvWithPointsOrCommas) {
  const std::string job = client().create(small_case(), v1::Job::SUCCEEDED);
  const std::string answer = get("/" + job + "/history.csv");
  EXPECT_THAT(lower_case(answer), AllOf(StartsWith("http/1.1 200"), HasSubstr("content-type: text/csv"),
                                        HasSubstr("content-disposition: attachment; filename=\"job-1-history.csv\"")));
  const std::string csv = dechunked(answer);
  EXPECT_THAT(csv, StartsWith("time_s,travel_mm,strain,stress_impact_mpa,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + static_cast<int>(client().history(job).size()));
  std::string commas = csv;
  for (char& letter : commas) letter = letter == ',' ? ';' : letter == '.' ? ',' : letter;
  EXPECT_EQ(dechunked(get("/" + job + "/history.csv?decimal=comma")), commas);
}

TEST_F(HttpDownloadTest, AResultHasTheBytesOfTheCall) {
  const std::string job = client().create(small_case(), v1::Job::SUCCEEDED);
  const std::string answer = get("/" + job + "/result.h5");
  EXPECT_THAT(lower_case(answer), HasSubstr("filename=\"job-1.h5\""));
  grpc::Status status;
  const std::string bytes = client().download(job, 0, status);
  EXPECT_THAT(answer, HasSubstr("Content-Length: " + std::to_string(bytes.size()) + "\r\n"));
  EXPECT_EQ(body_of(answer), bytes);
  const std::string rest = get("/" + job + "/result.h5", "Range: bytes=1000-\r\n");
  EXPECT_THAT(rest, AllOf(StartsWith("HTTP/1.1 206"),
                          HasSubstr("Content-Range: bytes 1000-" + std::to_string(bytes.size() - 1) + "/")));
  EXPECT_EQ(body_of(rest), bytes.substr(1000));
  const std::string past = "Range: bytes=" + std::to_string(bytes.size() + 1) + "-\r\n";
  EXPECT_THAT(get("/" + job + "/result.h5", past), StartsWith("HTTP/1.1 416"));
  const std::string head = exchange(request("HEAD /" + job + "/result.h5", ""));
  EXPECT_THAT(head, StartsWith("HTTP/1.1 200"));
  EXPECT_TRUE(head.ends_with("\r\n\r\n")) << "no body";
}

TEST_F(HttpDownloadTest, ASweepIsCsvWithARowForEachJob) {
  Client client = this->client();
  const auto sweep = create(client, sweep_of(small_case(), kSpeed, {80.0, 100.0}));
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, 2));
  const std::string csv = dechunked(get("/" + sweep.name() + ".csv"));
  EXPECT_THAT(csv, StartsWith("loading.speed_m_per_s,job,state,plateau_stress_impact_mpa,"));
  EXPECT_THAT(csv, AllOf(HasSubstr("\n80,jobs/1,SUCCEEDED,"), HasSubstr("\n100,jobs/2,SUCCEEDED,")));
}

TEST_F(HttpDownloadTest, ErrorsAreTextWithTheirStatus) {
  EXPECT_THAT(get("/jobs/99/history.csv"), AllOf(StartsWith("HTTP/1.1 404"), HasSubstr("text/plain")));
  EXPECT_THAT(get("/jobs/99/result.h5"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("/sweeps/99.csv"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("/jobs/1/other.csv"),
              AllOf(StartsWith("HTTP/1.1 404"), HasSubstr("text/plain"), HasSubstr("/jobs/NUMBER/history.csv")));
  EXPECT_THAT(get("/jobs/1/result.h5?each=1"), AllOf(StartsWith("HTTP/1.1 400"), HasSubstr("\"each=1\" is not valid")));
  EXPECT_THAT(get("/jobs/x/history.csv"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("/jobs/1/history.csv?decimal=semicolon"),
              AllOf(StartsWith("HTTP/1.1 400"), HasSubstr("decimal=comma or decimal=point")));
  EXPECT_THAT(get("/" + client().create(endless_case()) + "/result.h5"),
              AllOf(StartsWith("HTTP/1.1 400"), HasSubstr("has no result")));
}

TEST_F(HttpDownloadTest, TokensAreAskedForAsForCalls) {
  start(with_tokens(http_options()));
  EXPECT_THAT(get("/jobs/1/history.csv"), AllOf(StartsWith("HTTP/1.1 401"), HasSubstr("Authorization: Bearer TOKEN")));
  EXPECT_THAT(get("/jobs/1/history.csv", token_of("reader")), StartsWith("HTTP/1.1 404"));
}

}  // namespace
}  // namespace cellcrush::testing
