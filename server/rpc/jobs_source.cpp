#include "rpc/jobs_source.h"

#include <absl/strings/numbers.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "error_table.h"
#include "rpc/job_query.h"
#include "rpc/request_fields.h"
#include "store/job_state.h"
#include "store/resource_name.h"
#include "watch/job_source.h"

namespace cellcrush::rpc {
namespace {

constexpr int kChangesAtOnce = 256;

store::JobFilter filter_of(const std::string& text) {
  check_length("filter", text, kLongestFilter);
  auto filter = parse_filter(text);
  if (!filter.states.empty()) {
    throw InvalidField("filter", "has a condition on state, which changes during a watch.",
                       "Leave it out; each message has the state of its job.");
  }
  return filter;
}

}  // namespace

/// A requested job of a WatchJobs: what its WatchJob would send, and how it would end. Not thread-safe, except for
/// `wake`.
class JobsSource::WatchedJob {
 public:
  /// A request that is not valid throws nothing: its status is the first message.
  WatchedJob(store::JournalReader& journal, watch::Hub& hub, const v1::WatchJobRequest& request)
      : name_(request.name()) {
    Message::WatchedEvent named;
    named.set_job(name_);
    fields_ = named.SerializeAsString();
    const auto status = answer([&] {
      const std::int64_t job = find_job(journal, request.name()).number;
      check_epoch(journal.epoch(), request.epoch());
      source_.emplace(journal, hub, job, request.after_sequence(),
                      watch::WatchCursor::Wanted{request.frames(), true, request.encoding()});
    });
    if (!status.ok()) refused_ = status;
  }

  void open(const std::function<void()>& wake) {
    if (!source_) return;
    source_->open(wake);
    is_open_ = true;
  }
  void close() {
    if (std::exchange(is_open_, false)) source_->close();
  }

  std::optional<watch::SentMessage> next() {
    if (refused_) return end(*std::exchange(refused_, std::nullopt));
    if (!source_) return std::nullopt;
    std::optional<watch::SentMessage> event;
    const auto status = answer([&] { event = source_->next(); });
    if (!status.ok()) return end(status);
    if (!event) return source_->ended() ? std::optional(end(grpc::Status::OK)) : std::nullopt;
    auto watched = watch::nest(fields_, Message::WatchedEvent::kEventFieldNumber, *std::move(event));
    return watch::nest("", Message::kWatchedFieldNumber, std::move(watched));
  }
  [[nodiscard]] bool has_more() const { return source_ && source_->has_more(); }

 private:
  watch::SentMessage end(const grpc::Status& status) {
    close();
    source_.reset();
    Message out;
    out.mutable_watched_end()->set_job(name_);
    auto& sent = *out.mutable_watched_end()->mutable_status();
    if (!sent.ParseFromString(status.error_details())) sent.Clear();
    sent.set_code(status.error_code());
    sent.set_message(status.error_message());
    return watch::encode(std::move(out));
  }

  std::string name_;
  std::string fields_;  ///< of each WatchedEvent, encoded
  std::optional<watch::JobSource> source_;
  std::optional<grpc::Status> refused_;  ///< until it was sent
  bool is_open_ = false;
};

JobsSource::JobsSource(const ServiceParts& parts, const v1::WatchJobsRequest& request)
    : parts_(parts), filter_(filter_of(request.filter())), after_(change_in(request.resume_token())) {
  if (request.jobs_size() > kMostWatchedJobs) {
    throw InvalidField("jobs",
                       "has " + std::to_string(request.jobs_size()) + " entries; at most " +
                           std::to_string(kMostWatchedJobs) + " are possible.",
                       "Watch fewer jobs in one call.");
  }
  for (const auto& job : request.jobs())
    watched_.push_back(std::make_unique<WatchedJob>(parts_.reader, parts_.hub, job));
}

JobsSource::~JobsSource() = default;

// "EPOCH@CHANGE"
std::string JobsSource::token() const { return parts_.reader.epoch().id + "@" + std::to_string(after_); }

std::int64_t JobsSource::change_in(const std::string& token) const {
  if (token.empty()) return parts_.changes.last();
  check_length("resume_token", token, kLongestJobsToken);
  const auto at = token.find('@');
  std::int64_t change = -1;
  if (at == std::string::npos || !absl::SimpleAtoi(token.substr(at + 1), &change) || change < 0) {
    throw InvalidField("resume_token", "does not come from WatchJobs.",
                       "Use the most recent one, or none to watch from now on.");
  }
  if (!parts_.reader.epoch().admits(token.substr(0, at))) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "The resume_token comes" + parts_.reader.epoch().of_before() +
                           ": it may now refer to different changes. Watch without a resume_token, and list the jobs.");
  }
  if (change > parts_.changes.last() || !parts_.changes.has_all_after(change)) {
    throw ServiceError(ServiceError::Kind::out_of_range,
                       "The changes after the resume_token are no longer stored. Watch without a resume_token, and "
                       "list the jobs.");
  }
  return change;
}

void JobsSource::open(const std::function<void()>& wake) {
  subscription_ = parts_.hub.subscribe(wake);
  for (auto& job : watched_) job->open(wake);
}

void JobsSource::close() {
  parts_.hub.unsubscribe(subscription_);
  for (auto& job : watched_) job->close();
}

bool JobsSource::has_more() const {
  return !changes_.empty() || std::ranges::any_of(watched_, [](const auto& job) { return job->has_more(); });
}

std::optional<watch::SentMessage> JobsSource::next() {
  if (!std::exchange(snapshot_sent_, true)) {
    Message out;
    out.mutable_snapshot()->set_epoch(parts_.reader.epoch().id);
    out.set_resume_token(token());
    return watch::encode(std::move(out));
  }
  // Progress from before a change of state is outdated, and is not sent after it.
  if (auto out = next_change()) return watch::encode(*std::move(out));
  if (auto out = next_watched()) return out;
  if (auto out = next_progress()) return watch::encode(*std::move(out));
  return std::nullopt;
}

std::optional<JobsSource::Message> JobsSource::next_change() {
  if (changes_.empty() && parts_.changes.has_after(after_, stamp())) {
    const auto read = parts_.changes.after(after_, kChangesAtOnce);
    changes_.assign(read.begin(), read.end());
  }
  while (!changes_.empty()) {
    const store::Change change = changes_.front();
    changes_.pop_front();
    auto out = is_repeated(change) ? std::nullopt : message_of(change);
    after_ = change.number;
    if (!out) continue;
    out->set_resume_token(token());
    return out;
  }
  return std::nullopt;
}

store::ChangeReader::Stamp JobsSource::stamp() const {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return {parts_.hub.stamp(), std::chrono::duration_cast<std::chrono::seconds>(now).count()};
}

// A retry of many jobs changes their sweep as often; the last time says it all.
bool JobsSource::is_repeated(const store::Change& change) const {
  return change.kind == store::ChangeKind::sweep_changed &&
         std::any_of(changes_.begin(), changes_.end(), [&](const store::Change& later) {
           return later.kind == change.kind && later.resource == change.resource;
         });
}

// Nothing for what the filter leaves out or was deleted since.
std::optional<JobsSource::Message> JobsSource::message_of(const store::Change& change) {
  Message out;
  switch (change.kind) {
    case store::ChangeKind::job_state: {
      std::int64_t sequence = change.sequence;
      if (const auto ended = sequence == 0 ? parts_.reader.find_without_case(change.resource) : std::nullopt)
        sequence = ended->last_sequence;
      auto events = parts_.reader.events(change.resource, sequence - 1, 1);
      if (events.empty() || events.front().sequence() != sequence || !events.front().has_state()) break;
      v1::Job& job = *events.front().mutable_state();
      const bool passes = store::matches(filter_, job);
      if (store::is_terminal(job.state())) {
        wanted_.erase(change.resource);
        progress_of_.erase(change.resource);
      } else {
        wanted_[change.resource] = passes;
      }
      if (!passes) break;
      *out.mutable_job() = std::move(job);
      return out;
    }
    case store::ChangeKind::job_deleted: out.set_deleted_job(store::name_of(change.resource)); return out;
    case store::ChangeKind::sweep_changed: {
      auto sweep = parts_.sweeps.find_sweep(change.resource);
      if (!sweep) break;
      sweep->clear_case_();
      *out.mutable_sweep() = *std::move(sweep);
      return out;
    }
    case store::ChangeKind::sweep_deleted: out.set_deleted_sweep(store::sweep_name_of(change.resource)); return out;
  }
  return std::nullopt;
}

std::optional<watch::SentMessage> JobsSource::next_watched() {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    auto out = watched_[turn_++ % watched_.size()]->next();
    if (out) return out;
  }
  return std::nullopt;
}

std::optional<JobsSource::Message> JobsSource::next_progress() {
  for (const auto& [job, channel] : parts_.hub.channels()) {
    const auto newest = channel->newest();
    if (!newest.progress || progress_of_[job] == newest.progress_count || !is_wanted(job)) continue;
    progress_of_[job] = newest.progress_count;
    Message out;
    out.mutable_progress()->set_job(store::name_of(job));
    *out.mutable_progress()->mutable_progress() = *newest.progress;
    return out;
  }
  return std::nullopt;
}

bool JobsSource::is_wanted(std::int64_t job) {
  const auto known = wanted_.find(job);
  if (known != wanted_.end()) return known->second;
  const auto stored = parts_.reader.find_job(job);
  if (!stored || store::is_terminal(stored->job.state())) return false;
  return wanted_[job] = store::matches(filter_, stored->job);
}

watch::SentMessage JobsSource::bookmark() const {
  Message out;
  out.mutable_bookmark();
  out.set_resume_token(token());
  return watch::encode(std::move(out));
}

}  // namespace cellcrush::rpc
