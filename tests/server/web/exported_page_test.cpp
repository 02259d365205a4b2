#include "web/exported_page.h"

#include <absl/strings/escaping.h>
#include <gmock/gmock.h>
#include <openssl/sha.h>

#include "web/page_files.h"

namespace cellcrush::web {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string between(const std::string& text, std::string_view before, std::string_view after) {
  const auto begin = text.find(before) + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

std::string hash_of_policy(const std::string& text) {
  std::string digest(SHA256_DIGEST_LENGTH, '\0');
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(),
         reinterpret_cast<unsigned char*>(digest.data()));
  return "'sha256-" + absl::Base64Escape(digest) + "'";
}

TEST(ExportedPage, ThePolicyPermitsItsScriptAndStyleAndNoRequest) {
  const std::string head = exported_head("a");
  const std::string policy = between(head, "Content-Security-Policy\" content=\"", "\"");
  EXPECT_THAT(policy, HasSubstr("default-src 'none';"));
  EXPECT_THAT(policy, HasSubstr("script-src " + hash_of_policy(between(head, "type=\"module\">", "</script>")) + ";"));
  EXPECT_THAT(policy, HasSubstr("style-src " + hash_of_policy(between(head, "<style>", "</style>")) + ";"));
  EXPECT_THAT(policy, Not(HasSubstr("http")));
  EXPECT_THAT(head, Not(HasSubstr("src=\"/")));
  EXPECT_THAT(head, Not(HasSubstr("href=\"/")));
}

TEST(ExportedPage, TheBundleCanStandInAnElement) {
  const std::string script(find_page_file("/app.js")->bytes);
  EXPECT_THAT(script, Not(HasSubstr("</script")));
  EXPECT_THAT(script, Not(HasSubstr("<!--")));
  EXPECT_THAT(script, Not(HasSubstr("\r")));
  const std::string style(find_page_file("/app.css")->bytes);
  EXPECT_THAT(style, Not(HasSubstr("</style")));
  EXPECT_THAT(style, Not(HasSubstr("url(")));
}

TEST(HttpPage, GzipIsForWhomAsksForItAndNoPathLeadsOut) {
  EXPECT_EQ(find_page_file("/../etc/passwd"), nullptr);
  for (const char* yes : {"gzip", "br, gzip", "gzip;q=0.5, br", "deflate,gzip ; q=1"})
    EXPECT_TRUE(accepts_gzip(yes)) << yes;
  for (const char* no : {"", "br", "gzip;q=0", "gzip; q=0.000", "xgzip"}) EXPECT_FALSE(accepts_gzip(no)) << no;
}

}  // namespace
}  // namespace cellcrush::web
