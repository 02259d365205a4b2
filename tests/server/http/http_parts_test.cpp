#include <gtest/gtest.h>

#include "http/browser_rules.h"
#include "web/page_files.h"

namespace cellcrush::http {
namespace {

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

TEST(HttpPage, GzipIsForWhomAsksForItAndNoPathLeadsOut) {
  EXPECT_EQ(web::find_page_file("/../etc/passwd"), nullptr);
  for (const char* yes : {"gzip", "br, gzip", "gzip;q=0.5, br", "deflate,gzip ; q=1"})
    EXPECT_TRUE(web::accepts_gzip(yes)) << yes;
  for (const char* no : {"", "br", "gzip;q=0", "gzip; q=0.000", "xgzip"}) EXPECT_FALSE(web::accepts_gzip(no)) << no;
}

}  // namespace
}  // namespace cellcrush::http
