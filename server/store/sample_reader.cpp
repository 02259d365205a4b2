#include "store/sample_reader.h"

#include <algorithm>
#include <system_error>

#include "error.h"
#include "store/job_folder.h"
#include "store/report_log.h"
#include "store/resource_name.h"
#include "store/result_reader.h"

namespace cellcrush::store {
namespace {

bool is_there(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::exists(path, none);
}

// A warning has the step of its sample, except those of the ledger, which are found in all samples together.
void add_warnings(const v1::Summary& summary, v1::Sample& sample) {
  for (const auto& warning : summary.warnings()) {
    const bool is_of_ledger =
        warning.kind() == v1::Warning::ENERGY_DRIFT || warning.kind() == v1::Warning::CONTACTS_MAKE_ENERGY;
    if (warning.step() == sample.step() && !is_of_ledger) *sample.add_warnings() = warning;
  }
}

SampleReader::Found read_result(const std::filesystem::path& path, const SampleRange& range, const v1::Summary& summary,
                                PageRoom room) {
  constexpr std::int64_t kAtOnce = 1024;
  const ResultReader result(path);
  SampleReader::Found out;
  while (std::ssize(out.samples) < range.count) {
    const std::int64_t done = std::ssize(out.samples);
    auto samples = result.history(range.first + done, std::min(kAtOnce, range.count - done));
    out.is_cut = samples.empty();
    if (out.is_cut) break;
    for (auto& sample : samples) {
      add_warnings(summary, sample);
      if (!room.take(sample.ByteSizeLong())) return out;
      out.samples.push_back(std::move(sample));
    }
  }
  return out;
}

}  // namespace

SampleReader::Found SampleReader::read(const SampleRange& range, const v1::Summary& summary, PageRoom room) {
  if (range.count <= 0) return {};
  const JobFolder folder(root_ / name_of(range.job));
  // When a job ends, its result appears before its reports go, or they become its history; that may be now.
  for (int attempt = 0; attempt < 2; ++attempt) {
    for (const auto& path : {folder.history(), folder.reports()}) {
      if (!is_there(path)) continue;
      try {
        return read_log(path, range, room);
      } catch (const ServiceError&) {
        if (is_there(path)) throw;
      }
    }
    if (is_there(folder.result())) return read_result(folder.result(), range, summary, room);
  }
  return {{}, true};
}

// A worker that resumes reports samples again, with the same bits; the first report of each counts.
SampleReader::Found SampleReader::read_log(const std::filesystem::path& path, const SampleRange& range, PageRoom room) {
  ReportLogReader reader(path);
  const Place start = place_before(range);
  reader.start_at(start.offset);
  Place place = start;
  std::vector<Place> marks;
  Found out;
  for (v1::Sample sample; std::ssize(out.samples) < range.count;) {
    out.is_cut = reader.read_sample(sample) != ReportLogReader::Read::message;
    if (out.is_cut) break;
    if (sample.step() <= place.step) continue;
    if (place.count >= range.first && !room.take(sample.ByteSizeLong())) break;
    place = {place.count + 1, sample.step(), reader.offset()};
    if (place.count % kMarkEvery == 0) marks.push_back(place);
    if (place.count > range.first) out.samples.push_back(std::move(sample));
  }
  if (!out.is_cut) {
    keep(range, marks, place);
  } else if (start.offset > 0) {
    // A worker has cut off reports that were damaged, and made others of the same samples.
    {
      const MutexLock lock(mutex_);
      places_.erase(range.job);
    }
    return read_log(path, range, room);
  }
  return out;
}

SampleReader::Place SampleReader::place_before(const SampleRange& range) {
  const MutexLock lock(mutex_);
  const auto found = places_.find(range.job);
  if (found == places_.end() || found->second.run != range.run) return {};
  const Places& places = found->second;
  if (places.newest.count <= range.first) return places.newest;
  const auto behind = std::upper_bound(places.marks.begin(), places.marks.end(), range.first,
                                       [](std::int64_t first, const Place& place) { return first < place.count; });
  return behind == places.marks.begin() ? Place() : *std::prev(behind);
}

void SampleReader::keep(const SampleRange& range, const std::vector<Place>& marks, const Place& newest) {
  const MutexLock lock(mutex_);
  if (!places_.contains(range.job) && places_.size() >= kMostJobs) {
    places_.erase(std::min_element(places_.begin(), places_.end(), [](const auto& one, const auto& other) {
      return one.second.turn < other.second.turn;
    }));
  }
  Places& places = places_[range.job];
  if (places.run != range.run) places = {range.run, {}, {}, 0};
  places.turn = ++turn_;
  for (const Place& mark : marks) {
    if (places.marks.empty() || mark.count > places.marks.back().count) places.marks.push_back(mark);
  }
  if (newest.count > places.newest.count) places.newest = newest;
}

}  // namespace cellcrush::store
