#include "log_format.h"

#include <gtest/gtest.h>
#include <spdlog/details/log_msg.h>

#include <chrono>
#include <string>

namespace cellcrush {
namespace {

std::string line_of(const std::string& message) {
  const spdlog::log_clock::time_point time{std::chrono::milliseconds(1'700'000'000'042)};
  const spdlog::details::log_msg log(time, {}, "name", spdlog::level::warn, message);
  spdlog::memory_buf_t line;
  make_json_formatter()->format(log, line);
  return {line.data(), line.size()};
}

TEST(LogFormat, ALineIsAnObjectWithTheJobItIsAbout) {
  EXPECT_EQ(line_of("jobs/12: lost"),
            "{\"time\":\"2023-11-14T22:13:20.042Z\",\"level\":\"warning\",\"job\":\"jobs/12\","
            "\"message\":\"jobs/12: lost\"}\n");
  EXPECT_EQ(line_of("ends"), "{\"time\":\"2023-11-14T22:13:20.042Z\",\"level\":\"warning\",\"message\":\"ends\"}\n");
}

TEST(LogFormat, WhatJsonCannotHoldIsEscaped) {
  EXPECT_NE(line_of("a \"b\" \\ \n").find(R"("message":"a \"b\" \\ \u000a")"), std::string::npos)
      << line_of("a \"b\" \\ \n");
}

TEST(LogFormat, BytesThatAreNoTextAreEscapedInBothForms) {
  const std::string sound = "12 \xc2\xb5m, \xe2\x82\xac, \xf0\x9f\x98\x80";
  EXPECT_NE(line_of(sound).find("\"message\":\"" + sound + "\""), std::string::npos) << line_of(sound);
  // A stray byte, one cut off, one longer than it need be, a surrogate, beyond the last character, and a terminal's
  // command.
  const std::string unsound = "a\xff \xe2\x82 \xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xc2\x9b";
  const std::string json = R"(a\\xff \\xe2\\x82 \\xc0\\xaf \\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80 \\xc2\\x9b)";
  EXPECT_NE(line_of(unsound).find(json), std::string::npos) << line_of(unsound);
  spdlog::memory_buf_t line;
  make_text_formatter()->format({"name", spdlog::level::warn, unsound}, line);
  const std::string text = R"(a\xff \xe2\x82 \xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xc2\x9b)";
  EXPECT_NE(std::string(line.data(), line.size()).find(text), std::string::npos)
      << std::string(line.data(), line.size());
}

}  // namespace
}  // namespace cellcrush
