// What the daemon tells webhooks, a command and a collector of traces.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "error.h"
#include "notices/receiver.h"
#include "programs/certificates.h"
#include "server/daemon_process.h"
#include "server/http/http_receiver.h"
#include "server/http/http_socket.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kSecret = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw";

// The example of Standard Webhooks.
TEST(Signatures, AreThoseOfStandardWebhooks) {
  const std::string key = notices::key_of(kSecret);
  EXPECT_EQ(notices::signature_of(key, "msg_p5jXN8AQM9LWM0D4loKWxJek", "1614265330", R"({"test": 2432232314})"),
            "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=");
  for (const char* wrong : {"", "whsec_", "MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw", "whsec_c2hvcnQ=", "whsec_***"})
    EXPECT_EQ(notices::key_of(wrong), "") << wrong;
}

class NoticesTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  [[nodiscard]] DaemonOptions telling(const std::string& url) const {
    auto options = default_options();
    options.notices.webhooks = {url};
    options.notices.webhook_secret = secret(std::string(kSecret) + "\n");
    options.notices.pause = std::chrono::milliseconds(100);
    options.metrics = "127.0.0.1:0";
    return options;
  }

  [[nodiscard]] std::filesystem::path secret(const std::string& text) const {
    const auto out = folder_.path() / "secret";
    write_secret(out, text);
    return out;
  }

  [[nodiscard]] std::string scrape() const {
    const std::string& url = daemon_->metrics_url();
    const HttpSocket socket(std::stoi(url.substr(url.rfind(':') + 1)));
    socket.send("GET /metrics HTTP/1.0\r\n\r\n");
    return socket.read_to_end();
  }

  static std::vector<std::string> types_of(const std::vector<HttpReceiver::Request>& requests) {
    std::vector<std::string> out;
    for (const auto& request : requests) out.push_back(json::parse(request.body)["type"]);
    return out;
  }
};

TEST_F(NoticesTest, AnEndedJobIsToldOnceInASignedMessage) {
  HttpReceiver receiver;
  start(telling(receiver.url("/hook?token=secret")));
  const std::string job = finished_job();
  const auto first = receiver.wait_for(1);
  ASSERT_EQ(first.size(), 1U);
  const auto& [path, headers, body] = first.front();
  EXPECT_EQ(path, "/hook?token=secret");
  EXPECT_EQ(headers.at("content-type"), "application/json");
  EXPECT_EQ(headers.at("webhook-signature"), notices::signature_of(notices::key_of(kSecret), headers.at("webhook-id"),
                                                                   headers.at("webhook-timestamp"), body));
  EXPECT_NEAR(std::stod(headers.at("webhook-timestamp")), static_cast<double>(std::time(nullptr)), 30.0);
  const json told = json::parse(body);
  EXPECT_EQ(told["type"], "job.succeeded");
  EXPECT_EQ(told["data"]["job"]["name"], job);
  EXPECT_EQ(told["data"]["job"]["state"], "SUCCEEDED");
  EXPECT_EQ(told["timestamp"], told["data"]["job"]["state_time"]);
  EXPECT_NEAR(told["data"]["job"]["summary"]["plateau_stress_impact_mpa"].get<double>(),
              client().get(job).summary().plateau_stress_impact_mpa(), 1e-12);
  EXPECT_FALSE(told["data"]["job"].contains("case"));

  // A note afterwards is no end, nor is one that goes, nor the start of another daemon.
  ASSERT_TRUE(client().annotate(job, "looks right").ok());
  ASSERT_TRUE(client().annotate(job, "", "looks right").ok());
  finished_job(tiny_case());
  receiver.wait_for(2);
  EXPECT_TRUE(wait_until([&] {
    return scrape().find("result=\"delivered\",target=\"" + notices::host_of(receiver.url()) + "\"} 2") !=
           std::string::npos;
  }));
  daemon_.reset();
  start(telling(receiver.url("/hook?token=secret")));
  finished_job(tiny_case());
  const auto all = receiver.wait_for(3);
  EXPECT_THAT(types_of(all), ElementsAre("job.succeeded", "job.succeeded", "job.succeeded"));
  EXPECT_NE(all[1].headers.at("webhook-id"), all[2].headers.at("webhook-id"));
  EXPECT_THAT(scrape(), HasSubstr("cellcrush_notices_total{result=\"delivered\",target=\"127.0.0.1:"));
  EXPECT_EQ(scrape().find("token"), std::string::npos) << "What the URL holds is no label.";
}

TEST_F(NoticesTest, WhatIsNotTakenIsSentAgainInOrder) {
  std::atomic<int> calls = 0;
  HttpReceiver receiver([&](const auto&) { return ++calls <= 3 ? (calls == 2 ? 0 : 503) : 204; });
  start(telling(receiver.url()));
  const std::string one = finished_job(tiny_case());
  const std::string other = finished_job(tiny_case());
  const auto all = receiver.wait_for(5);
  ASSERT_EQ(all.size(), 5U);
  for (int i = 0; i < 4; ++i) EXPECT_THAT(all[i].body, HasSubstr("\"" + one + "\""));
  EXPECT_EQ(all[0].headers.at("webhook-id"), all[3].headers.at("webhook-id"));
  EXPECT_THAT(all[4].body, HasSubstr("\"" + other + "\""));
  EXPECT_THAT(scrape(), HasSubstr("cellcrush_notices_total{result=\"retried\",target=\"" +
                                  notices::host_of(receiver.url()) + "\"} 3"));
}

TEST_F(NoticesTest, AReceiverThatRefusesOneIsToldTheNext) {
  std::atomic<int> calls = 0;
  HttpReceiver receiver([&](const auto&) { return ++calls == 1 ? 422 : 200; });
  start(telling(receiver.url()));
  finished_job(tiny_case());
  finished_job(tiny_case());
  EXPECT_EQ(receiver.wait_for(2).size(), 2U);
  EXPECT_TRUE(wait_until([&] {
    return scrape().find("{result=\"dropped\",target=\"" + notices::host_of(receiver.url()) + "\"} 1") !=
           std::string::npos;
  }));
}

TEST_F(NoticesTest, ANewReceiverHearsOfWhatComes) {
  start();
  const std::string before = finished_job(tiny_case());
  daemon_.reset();
  HttpReceiver receiver;
  start(telling(receiver.url()));
  const std::string job = finished_job(tiny_case());
  EXPECT_THAT(receiver.wait_for(1).at(0).body, HasSubstr("\"" + job + "\""));
}

TEST_F(NoticesTest, TheNextDaemonGoesOnWhereTheReceiverWas) {
  std::atomic<bool> is_down = true;
  HttpReceiver receiver([&](const auto&) { return is_down ? 503 : 200; });
  start(telling(receiver.url()));
  const std::string one = finished_job(tiny_case());
  const std::string other = finished_job(tiny_case());
  receiver.wait_for(1);
  daemon_.reset();
  is_down = false;
  start(telling(receiver.url()));
  // The id of the first one, until it is taken, and then another.
  std::vector<HttpReceiver::Request> all;
  EXPECT_TRUE(wait_until([&] {
    all = receiver.requests();
    return all.back().headers.at("webhook-id") != all.front().headers.at("webhook-id");
  }));
  EXPECT_THAT(all.front().body, HasSubstr("\"" + one + "\""));
  EXPECT_THAT(all.back().body, HasSubstr("\"" + other + "\""));
}

TEST_F(NoticesTest, AReceiverThatNeverAnswersHoldsUpNothing) {
  std::atomic<bool> ends = false;
  HttpReceiver receiver([&](const auto&) {
    wait_until([&] { return ends.load(); });
    return 200;
  });
  start(telling(receiver.url()));
  for (int i = 0; i < 3; ++i) finished_job(tiny_case());
  const auto begin = std::chrono::steady_clock::now();
  daemon_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10)) << "Less than the receiver takes.";
  ends = true;
}

TEST_F(NoticesTest, TheEndOfASweepIsToldOnceAndOfEachJobIfWanted) {
  HttpReceiver receiver;
  auto options = telling(receiver.url());
  options.notices.types = {"sweep.ended", "job.failed"};
  start(options);
  auto client = this->client();
  const auto sweep = create(client, sweep_of(tiny_case(), kSpeed, {80.0, 90.0, 100.0}));
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, 3));
  const auto all = receiver.wait_for(1);
  ASSERT_EQ(all.size(), 1U);
  const json told = json::parse(all.front().body);
  EXPECT_EQ(told["type"], "sweep.ended");
  EXPECT_EQ(told["data"]["sweep"]["name"], sweep.name());
  finished_job(tiny_case());
  const auto next = create(client, sweep_of(tiny_case(), kSpeed, {80.0, 90.0}));
  ASSERT_TRUE(wait_for_count(client, next.name(), v1::Job::SUCCEEDED, 2));
  EXPECT_THAT(types_of(receiver.wait_for(2)), ElementsAre("sweep.ended", "sweep.ended"));

  // After a retry it ends again, under another id.
  auto failing = sweep_of(endless_case(), kSpeed, {1.0});
  failing.mutable_sweep()->set_time_limit_s(0.5);
  const auto failed = create(client, failing);
  ASSERT_TRUE(wait_for_count(client, failed.name(), v1::Job::FAILED, 1));
  EXPECT_THAT(types_of(receiver.wait_for(4)), ElementsAre("sweep.ended", "sweep.ended", "job.failed", "sweep.ended"));
  retry(client, failed.name());
  const auto again = receiver.wait_for(6);
  ASSERT_EQ(again.size(), 6U);
  EXPECT_NE(again[3].headers.at("webhook-id"), again[5].headers.at("webhook-id"));
}

TEST_F(NoticesTest, AHeldQueueIsToldAndItsRelease) {
  HttpReceiver receiver;
  auto options = telling(receiver.url());
  options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(100)};
  options.worker_program = folder_.path() / "program";
  start(options);
  client().create(tiny_case());
  const auto held = receiver.wait_for(1);
  ASSERT_FALSE(held.empty());
  const json told = json::parse(held.front().body);
  EXPECT_EQ(told["type"], "queue.held");
  EXPECT_EQ(told["data"]["executor"], "local");
  EXPECT_EQ(told["data"]["cause"], "worker");
  EXPECT_THAT(told["data"]["remedy"].get<std::string>(), HasSubstr("Reinstall"));
  std::filesystem::create_symlink(CELLCRUSHD_PROGRAM, options.worker_program);
  EXPECT_THAT(types_of(receiver.wait_for(3)),
              ::testing::UnorderedElementsAre("queue.held", "queue.released", "job.succeeded"));
}

TEST_F(NoticesTest, ACommandReadsTheNoticeAndIsRunAgainIfItFails) {
  auto options = default_options();
  options.notices.pause = std::chrono::milliseconds(50);
  options.notices.command = folder_.path() / "hook";
  const auto told = folder_.path() / "told";
  std::ofstream(options.notices.command) << "#!/bin/sh\ncat > " << (folder_.path() / "body").string()
                                         << "\necho \"$CELLCRUSH_NOTICE $CELLCRUSH_RESOURCE\" >> " << told.string()
                                         << "\n[ $(wc -l < " << told.string() << ") -ge 2 ]\n";
  chmod(options.notices.command.c_str(), 0700);
  start(options);
  const std::string job = finished_job(tiny_case());
  std::string text;
  EXPECT_TRUE(wait_until([&] {
    std::ifstream file(told);
    text.assign(std::istreambuf_iterator<char>(file), {});
    return std::ranges::count(text, '\n') == 2;
  }));
  EXPECT_EQ(text, "job.succeeded " + job + "\njob.succeeded " + job + "\n");
  EXPECT_EQ(json::parse(std::ifstream(folder_.path() / "body"))["data"]["job"]["name"], job);
}

TEST_F(NoticesTest, ATraceHasASpanForEachTimeOfTheJob) {
  HttpReceiver receiver;
  auto options = with_workers(1);
  options.notices.traces = receiver.url("/v1/traces");
  start(options);
  auto client = this->client();
  const std::string job = client.create(case_of_seconds(), v1::Job::RUNNING);
  ASSERT_TRUE(client.suspend(job).ok());
  ASSERT_TRUE(client.annotate(job, "soon").ok());
  ASSERT_TRUE(client.resume(job).ok());
  ASSERT_TRUE(client.watch(job).status.ok());
  const auto all = receiver.wait_for(1);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().path, "/v1/traces");
  const json body = json::parse(all.front().body);
  const json& resource = body["resourceSpans"][0];
  EXPECT_EQ(resource["resource"]["attributes"][0]["value"]["stringValue"], "cellcrushd");
  const json& spans = resource["scopeSpans"][0]["spans"];
  std::vector<std::string> names;
  for (const auto& span : spans) names.push_back(span["name"]);
  EXPECT_THAT(names, ElementsAre("job", "waiting", "running", "suspended", "waiting", "running"));
  EXPECT_FALSE(spans[0].contains("parentSpanId"));
  EXPECT_EQ(spans[0]["status"]["code"], 1);
  EXPECT_EQ(spans[0]["traceId"].get<std::string>().size(), 32U);
  EXPECT_EQ(spans[0]["spanId"].get<std::string>().size(), 16U);
  EXPECT_EQ(spans[0]["attributes"][0]["value"]["stringValue"], job);
  for (std::size_t i = 1; i < spans.size(); ++i) {
    EXPECT_EQ(spans[i]["parentSpanId"], spans[0]["spanId"]);
    EXPECT_EQ(spans[i]["traceId"], spans[0]["traceId"]);
    const auto& before = i == 1 ? spans[0]["startTimeUnixNano"] : spans[i - 1]["endTimeUnixNano"];
    EXPECT_EQ(spans[i]["startTimeUnixNano"], before) << "No time is left out.";
  }
  EXPECT_EQ(spans[5]["endTimeUnixNano"], spans[0]["endTimeUnixNano"]);
}

TEST_F(NoticesTest, OptionsThatCannotWorkAreRefusedWithTheRemedy) {
  const auto secret = this->secret(kSecret);
  const auto refusal = [&](const std::function<void(notices::Options&)>& change) {
    notices::Options options;
    options.webhooks = {"https://example.org/hook"};
    options.webhook_secret = secret;
    change(options);
    try {
      notices::check(options);
      return std::string();
    } catch (const ServiceError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_EQ(refusal([](auto& options) { options.webhooks = {"http://localhost:8000/x", "http://[::1]/"}; }), "");
  EXPECT_THAT(refusal([](auto& options) { options.webhooks = {"http://example.org/"}; }), HasSubstr("Use https://"));
  EXPECT_THAT(refusal([](auto& options) { options.webhooks = {"http://127.0.0.1.example.org/"}; }),
              HasSubstr("Use https://"));
  EXPECT_THAT(refusal([](auto& options) { options.webhooks = {"http://127.0.0.1@example.org/"}; }),
              HasSubstr("is not a URL that can be used"));
  EXPECT_THAT(refusal([](auto& options) { options.webhooks = {"file:///etc/passwd"}; }), HasSubstr("--webhook is not"));
  EXPECT_THAT(refusal([](auto& options) { options.webhooks = {"https://example.org/ -o x"}; }), HasSubstr("not a URL"));
  EXPECT_THAT(refusal([](auto& options) { options.webhooks = {"http://example.org/secret"}; }),
              ::testing::Not(HasSubstr("secret")));
  EXPECT_THAT(refusal([](auto& options) { options.webhook_secret.clear(); }), HasSubstr("belong together"));
  EXPECT_THAT(refusal([](auto& options) { options.webhooks.clear(); }), HasSubstr("belong together"));
  EXPECT_THAT(refusal([](auto& options) { options.traces = "127.0.0.1:4318"; }), HasSubstr("--traces is not"));
  EXPECT_THAT(refusal([](auto& options) { options.command = "mail"; }), HasSubstr("absolute path"));
  chmod(secret.c_str(), 0644);
  EXPECT_THAT(refusal([](auto&) {}), HasSubstr("readable by other users"));
  chmod(secret.c_str(), 0600);
  write_secret(secret, "whsec_c2hvcnQ=");
  EXPECT_THAT(refusal([](auto&) {}), HasSubstr("openssl rand"));
}

}  // namespace
}  // namespace cellcrush::testing
