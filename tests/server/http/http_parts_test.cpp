#include <gmock/gmock.h>

#include "error.h"
#include "google/rpc/status.pb.h"
#include "http/browser_rules.h"
#include "http/connect_protocol.h"
#include "web/page_files.h"

namespace cellcrush::http {
namespace {

using ::testing::HasSubstr;

TEST(HttpEnvelope, IsReadAsItWasWritten) {
  bool compressed = true;
  EXPECT_EQ(read_envelope(envelope(0, "abc"), compressed), "abc");
  EXPECT_FALSE(compressed);
  static_cast<void>(read_envelope(envelope(kCompressed, ""), compressed));
  EXPECT_TRUE(compressed);
  for (const std::string& wrong : {std::string(), std::string("ab"), envelope(0, "abc") + "d"})
    EXPECT_THROW(static_cast<void>(read_envelope(wrong, compressed)), ServiceError);
}

TEST(HttpError, IsJsonWithItsCode) {
  EXPECT_EQ(error_json({grpc::StatusCode::NOT_FOUND, "No \"x\"\n"}),
            R"({"code":"not_found","message":"No \"x\"\u000a"})");
  EXPECT_EQ(end_of_stream_json(grpc::Status::OK), "{}");
  google::rpc::Status rich;
  rich.add_details()->set_type_url("type.googleapis.com/a.B");
  rich.mutable_details(0)->set_value("abcd");
  EXPECT_EQ(error_json({grpc::StatusCode::ABORTED, "x", rich.SerializeAsString()}),
            R"({"code":"aborted","message":"x","details":[{"type":"a.B","value":"YWJjZA"}]})");
  EXPECT_EQ(http_status(grpc::StatusCode::UNAUTHENTICATED), 401U);
}

TEST(HttpBrowser, PagesOfOtherSitesAreRefused) {
  EXPECT_FALSE(check_browser({"localhost:80", "http://localhost:80", "same-origin"}, {80}));
  EXPECT_FALSE(check_browser({"[::1]:81", "", ""}, {81}));
  EXPECT_EQ(check_browser({"evil.example:81", "", ""}, {81})->status, 421U);
  EXPECT_EQ(check_browser({"localhost:82", "", ""}, {81})->status, 421U);
  EXPECT_EQ(check_browser({"localhost:81", "http://evil.example", ""}, {81})->status, 403U);
  EXPECT_EQ(check_browser({"localhost:81", "null", ""}, {81})->status, 403U);
  EXPECT_EQ(check_browser({"localhost:81", "", "cross-site"}, {81})->status, 403U);
  EXPECT_FALSE(check_browser({"crush.example:81", "https://crush.example:81", ""}, {81, true}));
  EXPECT_EQ(check_browser({"crush.example:81", "http://crush.example:81", ""}, {81, true})->status, 403U);
  EXPECT_EQ(check_browser({"crush.example:81", "https://evil.example", ""}, {81, true})->status, 403U);
}

TEST(HttpPage, PathsWithoutADotGiveTheIndex) {
  ASSERT_NE(web::find_page_file("/"), nullptr);
  EXPECT_EQ(web::find_page_file("/jobs/12"), web::find_page_file("/index.html"));
  EXPECT_EQ(web::find_page_file("/../etc/passwd"), nullptr);
  EXPECT_THAT(std::string(web::find_page_file("/")->bytes), HasSubstr("<html"));
}

TEST(HttpPage, GzipIsForWhomAsksForIt) {
  for (const char* yes : {"gzip", "br, gzip", "gzip;q=0.5, br", "deflate,gzip ; q=1"})
    EXPECT_TRUE(web::accepts_gzip(yes)) << yes;
  for (const char* no : {"", "br", "gzip;q=0", "gzip; q=0.000", "xgzip"}) EXPECT_FALSE(web::accepts_gzip(no)) << no;
  EXPECT_TRUE(web::gzip_of(*web::find_page_file("/")).starts_with("\x1f\x8b"));
}

}  // namespace
}  // namespace cellcrush::http
