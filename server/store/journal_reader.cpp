#include "store/journal_reader.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "error.h"
#include "store/job_rows.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

ServiceError unreadable_event(std::int64_t job, std::int64_t sequence, const std::string& why, std::int64_t last) {
  return {ServiceError::Kind::data_loss, "Event " + std::to_string(sequence) + " of " + name_of(job) +
                                             " cannot be read: " + why + " To continue past it, watch with " +
                                             "after_sequence " + std::to_string(last) + "."};
}

}  // namespace

// A sample has the next number that no state event has, counted on from the event with which the job last began again.
struct JournalReader::Numbers {
  std::int64_t samples = 0;
  std::int64_t begun_again = 0;
  bool has_ended = false;
  std::vector<std::pair<std::int64_t, std::string>> states;  ///< sequence and payload
  mutable std::int64_t missing = 0;  ///< number of a sample, from 1, that could not be read with these; 0: none

  // How many samples have numbers up to this one.
  [[nodiscard]] std::int64_t samples_up_to(std::int64_t sequence) const {
    const auto states_until = std::ranges::count_if(
        states, [&](const auto& state) { return state.first > begun_again && state.first <= sequence; });
    return std::clamp<std::int64_t>(sequence - begun_again - states_until, 0, samples);
  }

  [[nodiscard]] std::int64_t sequence_of(std::int64_t sample) const {
    std::int64_t out = begun_again + sample + 1;
    for (const auto& [sequence, payload] : states) out += sequence > begun_again && sequence <= out ? 1 : 0;
    return out;
  }

  // The state events after this one.
  [[nodiscard]] auto states_after(std::int64_t sequence) const {
    return std::ranges::upper_bound(states, sequence, {}, &std::pair<std::int64_t, std::string>::first);
  }

  // The last of the samples in a row with this one.
  [[nodiscard]] std::int64_t end_of_row(std::int64_t sequence) const {
    const auto next = states_after(sequence);
    return next == states.end() ? sequence_of(samples - 1) : next->first - 1;
  }
};

JournalReader::JournalReader(const std::filesystem::path& path)
    : database_(path), contents_(database_), epoch_(read_epoch(database_)), samples_(path.parent_path()) {}

StoredJob JournalReader::read_job(const Statement& row) {
  StoredJob out;
  out.number = row.integer(0);
  out.is_damaged = row.integer(6) == 0 || !read_job_bytes(row.bytes(1), row.integer(4), out.job);
  if (out.is_damaged) set_corrupt(out.job);
  v1::Case& submitted = *out.job.mutable_case_();
  out.has_case = row.integer(7) != 0 && contents_.read_case(row.bytes(2), submitted);
  if (!out.has_case) submitted.Clear();
  out.job.set_name(name_of(out.number));
  out.last_sequence = row.integer(3);
  out.samples = row.integer(5);
  return out;
}

std::optional<StoredJob> JournalReader::find_job(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_, std::string("SELECT ") + kJobColumns + " FROM jobs WHERE number = ?1");
  if (read.bind(1, job).step()) return read_job(read);
  // A job without its entry may still have events.
  if (!Statement(database_, "SELECT 1 FROM events WHERE job = ?1").bind(1, job).step()) return std::nullopt;
  StoredJob out;
  out.number = job;
  out.is_damaged = true;
  set_corrupt(out.job);
  out.job.set_name(name_of(job));
  return out;
}

std::optional<StoredJob> JournalReader::find_without_case(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT number, job, last_sequence, state, samples, checksum = expected_checksum FROM jobs "
                 "WHERE number = ?1");
  if (!read.bind(1, job).step()) return std::nullopt;
  StoredJob out;
  out.number = job;
  out.is_damaged = read.integer(5) == 0 || !read_job_bytes(read.bytes(1), read.integer(3), out.job);
  if (out.is_damaged) set_corrupt(out.job);
  out.job.set_name(name_of(job));
  out.last_sequence = read.integer(2);
  out.samples = read.integer(4);
  out.has_case = false;
  return out;
}

std::vector<v1::Job> JournalReader::states(std::int64_t job) {
  std::vector<v1::Job> out;
  for (const auto& [sequence, payload] : numbers_of(job).states) {
    if (!out.emplace_back().ParseFromString(payload) || out.back().state() == v1::Job::JOB_STATE_UNSPECIFIED)
      out.pop_back();
    else
      out.back().set_name(name_of(job));
  }
  return out;
}

bool JournalReader::has_job(std::int64_t job) {
  const MutexLock lock(mutex_);
  return store::has_job(database_, job);
}

std::vector<std::int64_t> JournalReader::deleted_jobs() {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT number FROM deleted_jobs WHERE number NOT IN (SELECT number FROM jobs)")
      .numbers();
}

JournalReader::Numbers JournalReader::numbers_of(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT samples, begun_again, ended_at IS NOT NULL, states, jobs.checksum = jobs.expected_checksum, "
                 "sequence, payload, events.checksum = events.expected_checksum FROM jobs "
                 "LEFT JOIN events ON events.job = jobs.number WHERE jobs.number = ?1 ORDER BY sequence");
  read.bind(1, job);
  Numbers out;
  std::int64_t states = 0;
  while (read.step()) {
    if (read.integer(4) == 0) throw unreadable_entry(job);
    out.samples = read.integer(0);
    out.begun_again = read.integer(1);
    out.has_ended = read.integer(2) != 0;
    states = read.integer(3);
    // No event has the number 0; a damaged one has no payload.
    if (read.integer(5) > 0) out.states.emplace_back(read.integer(5), read.integer(7) != 0 ? read.bytes(6) : "");
  }
  // The numbers of samples follow from those of the states.
  if (std::ssize(out.states) != states) throw unreadable_entry(job);
  return out;
}

SampleReader::Found JournalReader::find_samples(const Numbers& numbers, const SampleRange& range, PageRoom room) {
  v1::Job job;
  if (numbers.has_ended && !job.ParseFromString(numbers.states.back().second)) job.Clear();
  std::string why = "it is missing from the job's folder.";
  SampleReader::Found out;
  try {
    out = samples_.read(range, job.summary(), room);
  } catch (const ServiceError& error) {
    if (error.shortage() != Shortage::none) throw;
    out.is_cut = true;
    why = error.what();
  }
  if (out.is_cut) numbers.missing = range.first + std::ssize(out.samples) + 1;
  // Another worker may compute those of a job that has not ended again.
  if (!out.is_cut || !out.samples.empty() || !numbers.has_ended) return out;
  const std::int64_t sequence = numbers.sequence_of(range.first);
  throw unreadable_event(range.job, sequence, why, numbers.end_of_row(sequence));
}

void JournalReader::say_missing(std::int64_t job, const Numbers& numbers) {
  const MutexLock lock(mutex_);
  if (!said_.emplace(job, numbers.begun_again).second) return;
  spdlog::error("Sample {} of {} and those behind it are missing or damaged. Run `cellcrushd verify`.", numbers.missing,
                name_of(job));
}

template <typename Use>
void JournalReader::with_numbers(std::int64_t job, const Use& use) {
  Numbers numbers = numbers_of(job);
  while (true) {
    use(numbers);
    // If the job has begun again meanwhile, there may be other samples in the place of those.
    Numbers now = numbers_of(job);
    if (now.begun_again == numbers.begun_again) {
      if (numbers.missing > 0 && !now.states.empty()) say_missing(job, numbers);
      return;
    }
    numbers = std::move(now);
  }
}

std::vector<v1::JobEvent> JournalReader::events(std::int64_t job, std::int64_t after, int limit) {
  std::vector<v1::JobEvent> out;
  with_numbers(job, [&](const Numbers& numbers) { out = read_events(job, numbers, after, limit); });
  return out;
}

std::vector<v1::JobEvent> JournalReader::read_events(std::int64_t job, const Numbers& numbers, std::int64_t after,
                                                     int limit) {
  std::vector<v1::JobEvent> out;
  SampleRange range{job, numbers.begun_again, numbers.samples_up_to(after), 0};
  for (auto state = numbers.states_after(after); std::ssize(out) < limit;) {
    const std::int64_t sample = range.first + range.count;
    const bool is_state =
        state != numbers.states.end() && (sample == numbers.samples || state->first < numbers.sequence_of(sample));
    if (!is_state && sample == numbers.samples) break;
    v1::JobEvent& event = out.emplace_back();
    if (!is_state) {
      event.set_sequence(numbers.sequence_of(sample));
      ++range.count;
      continue;
    }
    event.set_sequence(state->first);
    v1::Job& read = *event.mutable_state();
    if (!read.ParseFromString(state->second) || read.state() == v1::Job::JOB_STATE_UNSPECIFIED) {
      out.pop_back();
      if (out.empty()) throw unreadable_event(job, state->first, "the journal was damaged.", state->first);
      break;
    }
    read.set_name(name_of(job));
    if (read.executor().empty()) read.set_executor(kLocalExecutor);
    ++state;
  }
  // Without those that cannot be read, and what follows them.
  const bool begins_with_sample = !out.empty() && !out.front().has_state();
  SampleReader::Found found;
  try {
    found = find_samples(numbers, range, {});
  } catch (const ServiceError& error) {
    if (begins_with_sample || error.kind() != ServiceError::Kind::data_loss) throw;
  }
  auto sample = found.samples.begin();
  const auto end = std::ranges::find_if(out, [&](v1::JobEvent& event) {
    if (event.has_state()) return false;
    if (sample == found.samples.end()) return true;
    *event.mutable_sample() = std::move(*sample++);
    return false;
  });
  out.erase(end, out.end());
  return out;
}

StoredSamples JournalReader::samples(std::int64_t job, std::int64_t after, PageRoom room) {
  StoredSamples out;
  with_numbers(job, [&](const Numbers& numbers) {
    const std::int64_t first = numbers.samples_up_to(after);
    auto found = find_samples(numbers, {job, numbers.begun_again, first, numbers.samples - first}, room);
    const std::int64_t end = first + std::ssize(found.samples);
    out.last_sequence = found.samples.empty() ? 0 : numbers.sequence_of(end - 1);
    out.has_more = end < numbers.samples && (numbers.has_ended || !found.is_cut);
    out.samples = std::move(found.samples);
  });
  return out;
}

std::optional<v1::Mesh> JournalReader::mesh(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT mesh, checksum = expected_checksum FROM meshes WHERE job = ?1");
  if (!read.bind(1, job).step()) return std::nullopt;
  v1::Mesh mesh;
  if (read.integer(1) != 0 && contents_.read_mesh(read.bytes(0), mesh)) return mesh;
  spdlog::error("The mesh of {} cannot be read: the journal was damaged.", name_of(job));
  return std::nullopt;
}

}  // namespace cellcrush::store
