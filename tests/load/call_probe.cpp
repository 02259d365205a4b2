#include "load/call_probe.h"

#include <fmt/core.h>

#include <chrono>
#include <utility>

#include "load/figures.h"
#include "server/small_case.h"

namespace cellcrush::load {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kBetweenCalls{5};
constexpr std::chrono::seconds kLongestCall{600};

}  // namespace

CallProbe::CallProbe(const std::string& address, const std::string& job) : reading_(address), writing_(address) {
  reader_ = std::jthread([this, job](const std::stop_token& stop) {
    call(stop, reads_, [this, &job] {
      v1::GetJobRequest request;
      request.set_name(job);
      v1::Job found;
      const auto status = reading_.jobs->GetJob(testing::bounded_context(kLongestCall).get(), request, &found);
      if (!status.ok()) fmt::print("a GetJob failed: {}\n", status.error_message());
    });
  });
  writer_ = std::jthread([this](const std::stop_token& stop) {
    v1::CreateJobRequest request;
    *request.mutable_case_() = testing::small_case();
    request.set_request_id("probe");
    request.set_priority(-100);
    call(stop, writes_, [this, &request] {
      v1::Job made;
      const auto status = writing_.jobs->CreateJob(testing::bounded_context(kLongestCall).get(), request, &made);
      if (!status.ok()) fmt::print("a submit failed: {}\n", status.error_message());
    });
  });
}

void CallProbe::call(const std::stop_token& stop, std::vector<double>& seconds, const std::function<void()>& once) {
  while (!stop.stop_requested()) {
    const auto start = Clock::now();
    once();
    const std::chrono::duration<double> taken = Clock::now() - start;
    {
      const std::scoped_lock lock(mutex_);
      seconds.push_back(taken.count());
    }
    std::this_thread::sleep_for(kBetweenCalls);
  }
}

void CallProbe::print(const std::string& during) {
  // A call that waits since the start of it counts once it ends.
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::scoped_lock lock(mutex_);
  for (auto [what, seconds] : {std::pair{"GetJob", &reads_}, {"a repeated submit", &writes_}}) {
    if (!seconds->empty()) fmt::print("  meanwhile {}, {}: {}\n", what, during, describe(*seconds));
    seconds->clear();
  }
}

}  // namespace cellcrush::load
