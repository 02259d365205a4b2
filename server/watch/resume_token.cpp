#include "watch/resume_token.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::watch {
namespace {

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

}  // namespace cellcrush::watch
