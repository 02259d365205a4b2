#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "programs/temporary_folder.h"
#include "server/sample_writer.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::watch {

/// A source of messages, each as it is received.
template <class Source, class Message>
class Received : public Source {
 public:
  using Source::Source;

  std::optional<Message> next() {
    const auto sent = Source::next();
    return sent ? std::optional(sent->template parsed<Message>()) : std::nullopt;
  }
};

/// A journal, and a hub to which it announces what is durable.
class WatchFixture : public ::testing::Test {
 protected:
  void change(std::int64_t job, v1::Job::State state) {
    store::StateChange change;
    change.state = state;
    journal_.change_state(job, change);
  }

  void add_samples(std::int64_t job, int count) {
    for (int i = 0; i < count; ++i) {
      v1::Sample sample;
      sample.set_step(steps_[job]++);
      reported_.add(journal_, job, sample);
    }
  }

  testing::TemporaryFolder folder_;
  testing::SampleWriter reported_{folder_.path()};
  Hub hub_;
  store::Journal journal_{folder_.path() / "journal.sqlite", [this](std::int64_t job) { hub_.announce(job); }};
  store::JournalReader reader_{folder_.path() / "journal.sqlite"};
  std::map<std::int64_t, std::int64_t> steps_;  ///< of the next sample of each job
};

}  // namespace cellcrush::watch
