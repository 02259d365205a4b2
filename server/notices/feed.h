#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "jobs/queues.h"
#include "notices/notice.h"
#include "store/change_reader.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"

namespace cellcrush::notices {

/// Makes notices of the journal's changes, for one receiver. Not thread-safe.
class Feed {
 public:
  /// Dependencies; all outlive the feed.
  struct Parts {
    store::ChangeReader& changes;
    store::JournalReader& reader;
    store::SweepReader& sweeps;
    std::string epoch;  ///< of callers: begins the ids
  };
  using Wants = std::function<bool(const std::string& type)>;

  /// `after`: number of the last change that the receiver has seen.
  Feed(const Parts& parts, std::int64_t after, Wants wants)
      : parts_(parts), wants_(std::move(wants)), position_(after) {}

  /// The notices of the next change that has any the receiver wants; none once all changes were read or a stop is
  /// requested. Skips what was deleted meanwhile, and a change or job that is damaged, which the log names. Throws
  /// ServiceError if the journal cannot be read now.
  std::vector<Notice> next(const std::stop_token& stop);

  /// Number of the last change whose notices `next` has returned.
  [[nodiscard]] std::int64_t position() const { return position_; }

  /// Whether the journal had dropped changes that were not read, since the last call.
  [[nodiscard]] bool has_missed() { return std::exchange(has_missed_, false); }

 private:
  std::vector<Notice> notices_of(const store::Change& change);
  void add_sweep(const std::string& name, std::vector<Notice>& out);
  bool has_ended(std::int64_t sweep);

  Parts parts_;
  Wants wants_;
  std::int64_t position_;
  bool has_missed_ = false;
  std::map<std::int64_t, std::int64_t> unended_;  ///< by sweep: a job that was seen before its end
  std::map<std::int64_t, std::int64_t> told_;     ///< by sweep whose end was told: its newest job then
};

/// The notice of a queue that is held from now on, or not any more.
Notice notice_of_queue(const std::string& epoch, const std::string& executor, const jobs::Hold* hold);

}  // namespace cellcrush::notices
