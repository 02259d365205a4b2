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

}  // namespace
}  // namespace cellcrush
