#include "watch/sweep_source.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "error.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::watch {
namespace {

constexpr int kLongestTurn = 256;
// Sent with every event. A longer token at most doubles what a watch sends.
constexpr std::size_t kShortToken = 1024;
constexpr std::size_t kRunBytes = 16;  // of a token, about

// "SWEEP:FIRST+COUNT=SEQUENCE;..." with one run for consecutive jobs at the same position; SEQUENCE is "e" for ended
// jobs.
constexpr std::int64_t kMostJobs = 100'000;
constexpr std::int64_t kLargestNumber = std::int64_t{1} << 62;

bool continues(const JobPlace& before, const JobPlace& place) {
  return place.job == before.job + 1 && place.ended == before.ended &&
         (place.ended || place.sequence == before.sequence);
}

// Parses a token from left to right.
class Reader {
 public:
  explicit Reader(std::string_view rest) : rest_(rest) {}

  std::int64_t number() {
    std::int64_t out = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), out);
    sound_ = sound_ && error == std::errc() && out >= 0;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return out;
  }

  bool skip(char character) {
    if (rest_.empty() || rest_.front() != character) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void expect(char character) { sound_ = skip(character) && sound_; }

  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  bool sound_ = true;
};

}  // namespace

JobPlaces::JobPlaces(std::vector<JobPlace> places) : places_(std::move(places)) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (i == 0 || !continues(places_[i - 1], places_[i])) runs_.insert(runs_.end(), i);
  }
}

void JobPlaces::set_sequence(std::size_t index, std::int64_t sequence) {
  places_[index].sequence = sequence;
  update_runs(index);
}

void JobPlaces::set_ended(std::size_t index) {
  places_[index].ended = true;
  update_runs(index);
}

// Only a run that begins at this job or at the next one can have changed.
void JobPlaces::update_runs(std::size_t index) {
  for (std::size_t i = std::max<std::size_t>(index, 1); i <= index + 1 && i < places_.size(); ++i)
    continues(places_[i - 1], places_[i]) ? static_cast<void>(runs_.erase(i)) : static_cast<void>(runs_.insert(i));
}

std::string JobPlaces::token(std::int64_t sweep) const {
  std::string out = std::to_string(sweep) + ":";
  for (auto run = runs_.begin(); run != runs_.end();) {
    const JobPlace& first = places_[*run];
    const std::size_t begin = *run++;
    const std::size_t end = run == runs_.end() ? places_.size() : *run;
    out += std::to_string(first.job) + "+" + std::to_string(end - begin) + "=";
    out += (first.ended ? "e" : std::to_string(first.sequence)) + ";";
  }
  return out;
}

std::map<std::int64_t, JobPlace> parse_resume_token(std::int64_t sweep, const std::string& token) {
  Reader reader(token);
  bool sound = reader.number() == sweep;
  reader.expect(':');
  std::map<std::int64_t, JobPlace> out;
  std::int64_t next = 0;
  while (sound && reader.sound() && !reader.at_end()) {
    JobPlace place;
    place.job = reader.number();
    reader.expect('+');
    const std::int64_t count = reader.number();
    reader.expect('=');
    place.ended = reader.skip('e');
    if (!place.ended) place.sequence = reader.number();
    reader.expect(';');
    // Ascending, as encoded: repeated jobs would take minutes and exceed the limit on their number.
    sound =
        place.job >= next && place.job < kLargestNumber && count <= kMostJobs - static_cast<std::int64_t>(out.size());
    for (std::int64_t i = 0; sound && reader.sound() && i < count; ++i, ++place.job) out[place.job] = place;
    next = place.job;
  }
  if (!sound || !reader.sound()) {
    throw ServiceError(ServiceError::Kind::invalid,
                       "The resume_token does not belong to " + store::sweep_name_of(sweep) +
                           ". Use the most recent one, or none to start from the beginning.");
  }
  return out;
}
void SweepSource::News::add(std::size_t position) {
  const MutexLock lock(mutex_);
  if (is_queued_[position]) return;
  is_queued_[position] = true;
  queue_.push_back(position);
}

bool SweepSource::News::add_first(std::size_t position) {
  const MutexLock lock(mutex_);
  if (is_queued_[position]) return false;
  is_queued_[position] = true;
  queue_.push_front(position);
  return true;
}

std::optional<std::size_t> SweepSource::News::take() {
  const MutexLock lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  const std::size_t position = queue_.front();
  queue_.pop_front();
  is_queued_[position] = false;
  return position;
}

SweepSource::SweepSource(store::JournalReader& journal, store::SweepReader& sweeps, Hub& hub, std::int64_t sweep,
                         const std::string& resume_token)
    : journal_(journal), sweeps_(sweeps), hub_(hub), sweep_(sweep) {
  std::map<std::int64_t, JobPlace> given;
  if (!resume_token.empty()) given = places_in(resume_token);
  auto jobs = sweeps.jobs_of(sweep);
  std::sort(jobs.begin(), jobs.end());
  std::vector<JobPlace> places;
  for (const std::int64_t job : jobs) {
    const auto found = given.find(job);
    places.push_back(found == given.end() ? JobPlace{job, 0, false} : found->second);
    members_.push_back({hub.open(job), 0, std::nullopt});
  }
  places_ = JobPlaces(std::move(places));
  news_ = std::make_shared<News>(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].ended) continue;
    ++left_;
    news_->add(i);
  }
}

// "EPOCH@" and the positions; a token without an epoch is of an earlier version.
std::string SweepSource::resume_token() const { return journal_.epoch().id + "@" + places_.token(sweep_); }

bool SweepSource::is_token_due(std::size_t event_bytes) {
  const std::size_t token_bytes = places_.run_count() * kRunBytes;
  bytes_since_token_ += event_bytes;
  if (token_bytes > kShortToken && bytes_since_token_ < token_bytes) return false;
  bytes_since_token_ = 0;
  return true;
}

std::map<std::int64_t, JobPlace> SweepSource::places_in(const std::string& token) const {
  const auto at = token.find('@');
  const bool has_epoch = at != std::string::npos;
  auto places = parse_resume_token(sweep_, has_epoch ? token.substr(at + 1) : token);
  if (!journal_.epoch().admits(has_epoch ? token.substr(0, at) : "")) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "The resume_token comes" + journal_.epoch().of_before() +
                           ": it may now refer to different jobs. Watch " + store::sweep_name_of(sweep_) +
                           " without a resume_token.");
  }
  return places;
}

void SweepSource::open(const std::function<void()>& wake) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (places_[i].ended) continue;
    members_[i].subscription = members_[i].channel->subscribe(
        [news = news_, wake, i] {
          news->add(i);
          wake();
        },
        false);
  }
}

void SweepSource::close() {
  for (auto& member : members_) member.channel->unsubscribe(member.subscription);
}

std::optional<SentMessage> SweepSource::next() {
  if (!std::exchange(snapshot_sent_, true)) return snapshot();
  while (const auto position = news_->take()) {
    if (places_[*position].ended) continue;
    auto message = next_of(*position);
    if (!message) {
      in_turn_ = 0;
      continue;
    }
    // It may have more: its turn continues, or it queues again.
    if (++in_turn_ >= kLongestTurn || !news_->add_first(*position)) {
      // The next job has its turn; its events are in the journal.
      in_turn_ = 0;
      has_more_ = false;
      news_->add(*position);
    }
    return message;
  }
  return std::nullopt;
}

std::optional<SentMessage> SweepSource::next_of(std::size_t position) {
  const JobPlace& place = places_[position];
  auto& cursor = members_[position].cursor;
  try {
    if (!cursor) {
      cursor.emplace(journal_, hub_, place.job, place.sequence, WatchCursor::Wanted{false, false});
    }
    auto event = cursor->next();
    has_more_ = cursor->has_more();
    places_.set_sequence(position, cursor->sequence());
    if (cursor->ended()) end(position);
    if (!event) return std::nullopt;
    v1::WatchSweepResponse out;
    out.set_job(store::name_of(place.job));
    const bool advances = event->is_numbered || place.ended;
    if (advances && is_token_due(event->size())) out.set_resume_token(resume_token());
    return nest(out.SerializeAsString(), v1::WatchSweepResponse::kEventFieldNumber, *std::move(event));
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::not_found) throw;
  }
  // The job was deleted: the sweep continues without it.
  end(position);
  return std::nullopt;
}

void SweepSource::end(std::size_t position) {
  places_.set_ended(position);
  has_more_ = false;
  members_[position].cursor.reset();
  --left_;
}

SentMessage SweepSource::bookmark() const {
  v1::WatchSweepResponse out;
  out.mutable_event()->mutable_bookmark();
  out.set_resume_token(resume_token());
  return encode(std::move(out));
}

SentMessage SweepSource::snapshot() {
  auto sweep = sweeps_.find_sweep(sweep_);
  if (!sweep) throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::sweep_name_of(sweep_) + ".");
  if (!sweep->has_create_time()) throw store::unreadable_sweep(sweep_);
  v1::WatchSweepResponse out;
  *out.mutable_snapshot() = *std::move(sweep);
  out.set_resume_token(resume_token());
  return encode(std::move(out));
}

}  // namespace cellcrush::watch
