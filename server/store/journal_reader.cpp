#include "store/journal_reader.h"

#include <spdlog/spdlog.h>

#include <string>
#include <utility>

#include "error.h"
#include "store/journal_mending.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

// An event's payload. False when it cannot be read.
bool read_event(int kind, const std::string& payload, v1::JobEvent& event) {
  if (kind != kStateEvent) return event.mutable_sample()->ParseFromString(payload);
  return event.mutable_state()->ParseFromString(payload) && event.state().state() != v1::Job::JOB_STATE_UNSPECIFIED;
}

ServiceError unreadable_event(std::int64_t job, std::int64_t sequence) {
  const std::string number = std::to_string(sequence);
  return {ServiceError::Kind::data_loss,
          "Event " + number + " of " + name_of(job) +
              " cannot be read: the journal was damaged. To continue past it, watch with after_sequence " + number +
              "."};
}

}  // namespace

JournalReader::JournalReader(const std::filesystem::path& path) : database_(path), epoch_(read_epoch(database_)) {}

StoredJob JournalReader::read_job(const Statement& row) {
  StoredJob out;
  out.number = row.integer(0);
  if (!read_job_bytes(row.bytes(1), row.integer(4), out.job)) set_corrupt(out.job);
  if (!out.job.mutable_case_()->ParseFromString(row.bytes(2))) out.job.mutable_case_()->Clear();
  out.job.set_name(name_of(out.number));
  out.last_sequence = row.integer(3);
  return out;
}

std::optional<StoredJob> JournalReader::find_job(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT number, job, submitted_case, last_sequence, state FROM jobs WHERE number = ?1");
  if (!read.bind(1, job).step()) return std::nullopt;
  return read_job(read);
}

bool JournalReader::has_job(std::int64_t job) {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT 1 FROM jobs WHERE number = ?1").bind(1, job).step();
}

std::vector<std::int64_t> JournalReader::deleted_jobs() {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT number FROM deleted_jobs ORDER BY number");
  std::vector<std::int64_t> out;
  while (read.step()) out.push_back(read.integer(0));
  return out;
}

std::vector<v1::JobEvent> JournalReader::events(std::int64_t job, std::int64_t after, int limit) {
  const MutexLock lock(mutex_);
  Statement read(
      database_,
      "SELECT sequence, kind, payload FROM events WHERE job = ?1 AND sequence > ?2 ORDER BY sequence LIMIT ?3");
  read.bind(1, job).bind(2, after).bind(3, limit);
  std::vector<v1::JobEvent> out;
  while (read.step()) {
    v1::JobEvent& event = out.emplace_back();
    event.set_sequence(read.integer(0));
    if (!read_event(static_cast<int>(read.integer(1)), read.bytes(2), event)) {
      if (out.size() == 1) throw unreadable_event(job, event.sequence());
      // Those before it can be given.
      out.pop_back();
      break;
    }
    if (!event.has_state()) continue;
    event.mutable_state()->set_name(name_of(job));
    if (event.state().executor().empty()) event.mutable_state()->set_executor(kLocalExecutor);
  }
  return out;
}

StoredSamples JournalReader::samples(std::int64_t job, std::int64_t after, PageRoom room) {
  const MutexLock lock(mutex_);
  Statement read(
      database_,
      "SELECT payload, sequence FROM events WHERE job = ?1 AND sequence > ?2 AND kind = ?3 ORDER BY sequence");
  read.bind(1, job).bind(2, after).bind(3, kSampleEvent);
  StoredSamples out;
  while (read.step()) {
    const std::string payload = read.bytes(0);
    v1::Sample sample;
    const bool sound = sample.ParseFromString(payload);
    if (!sound && out.samples.empty()) throw unreadable_event(job, read.integer(1));
    out.has_more = !sound || !room.take(payload.size());
    if (out.has_more) break;
    out.samples.push_back(std::move(sample));
    out.last_sequence = read.integer(1);
  }
  return out;
}

std::int64_t JournalReader::last_sampled_step(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT payload, sequence FROM events WHERE job = ?1 AND kind = ?2 ORDER BY sequence DESC LIMIT 1");
  if (!read.bind(1, job).bind(2, kSampleEvent).step()) return -1;
  v1::Sample sample;
  if (!sample.ParseFromString(read.bytes(0))) throw unreadable_event(job, read.integer(1));
  return sample.step();
}

std::optional<v1::Mesh> JournalReader::mesh(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT mesh FROM meshes WHERE job = ?1");
  if (!read.bind(1, job).step()) return std::nullopt;
  v1::Mesh mesh;
  if (mesh.ParseFromString(read.bytes(0))) return mesh;
  spdlog::error("The mesh of {} cannot be read: the journal was damaged.", name_of(job));
  return std::nullopt;
}

}  // namespace cellcrush::store
