#include "watch/resume_token.h"

#include <charconv>
#include <string_view>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::watch {
namespace {

// "SWEEP:FIRST+COUNT=SEQUENCE;..." with one run for consecutive jobs at the same position; SEQUENCE is "e" for ended
// jobs.
constexpr std::int64_t kMostJobs = 100'000;
constexpr std::int64_t kLargestNumber = std::int64_t{1} << 62;

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

std::string resume_token_of(std::int64_t sweep, const std::vector<JobPlace>& places) {
  std::string out = std::to_string(sweep) + ":";
  for (std::size_t i = 0; i < places.size();) {
    const JobPlace& first = places[i];
    std::size_t end = i + 1;
    while (end < places.size() && places[end].job == first.job + static_cast<std::int64_t>(end - i) &&
           places[end].ended == first.ended && (first.ended || places[end].sequence == first.sequence))
      ++end;
    out += std::to_string(first.job) + "+" + std::to_string(end - i) + "=";
    out += (first.ended ? "e" : std::to_string(first.sequence)) + ";";
    i = end;
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
