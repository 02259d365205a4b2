#include "heartbeats.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "pause.h"

namespace cellcrush {

Heartbeats::Heartbeats(std::vector<Loop> loops, const Times& times, Tell tell) : times_(times), tell_(std::move(tell)) {
  for (Loop& loop : loops) {
    const auto pulse = pulses_.emplace_back(std::make_shared<Pulse>());
    pulse->name = std::move(loop.name);
    pulse->patience = loop.patience * times.patience;
    const Beat beat = [pulse] {
      pulse->last = std::chrono::system_clock::now();
      pulse->missed = 0;
      pulse->is_asked = false;
    };
    threads_.emplace_back(
        [pulse, beat, ask = std::move(loop.ask), interval = times.interval](const std::stop_token& stop) {
          do {
            if (pulse->is_asked.exchange(true)) continue;
            try {
              ask(beat);
            } catch (const std::exception&) {
              pulse->is_asked = false;
            }
          } while (pause_unless_stopped(stop, interval));
        });
  }
  threads_.emplace_back([this](const std::stop_token& stop) { watch(stop); });
}

void Heartbeats::watch(const std::stop_token& stop) const {
  while (pause_unless_stopped(stop, times_.interval)) {
    std::string stuck;
    for (const auto& pulse : pulses_) {
      const bool was_stuck = std::exchange(pulse->is_stuck, ++pulse->missed > pulse->patience);
      if (!pulse->is_stuck && was_stuck) spdlog::info("{} makes progress again.", pulse->name);
      if (!pulse->is_stuck) continue;
      const auto since = std::chrono::floor<std::chrono::seconds>(pulse->last.load());
      const std::string words =
          fmt::format("{} has made no progress since {:%Y-%m-%dT%H:%M:%S}Z.", pulse->name, fmt::gmtime(since));
      if (!was_stuck) spdlog::error("{} Health is NOT_SERVING until it does.", words);
      stuck += (stuck.empty() ? "" : " ") + words;
    }
    tell_(stuck);
  }
}

}  // namespace cellcrush
