#include "store/sample_reader.h"

#include <algorithm>
#include <numeric>
#include <system_error>

#include "error.h"
#include "store/job_folder.h"
#include "store/report_log.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

constexpr std::int64_t kMarkEvery = 4096;
constexpr std::size_t kMostPlaces = 4096;
constexpr std::int64_t kBlockSamples = 256;
constexpr std::size_t kMostBlocks = 32;
constexpr std::size_t kMostBlockBytes = 1 << 20;

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
  Found out;
  for (v1::Sample sample; std::ssize(out.samples) < range.count;) {
    out.is_cut = reader.read_sample(sample) != ReportLogReader::Read::message;
    if (out.is_cut) break;
    if (sample.step() <= place.step) continue;
    if (place.count >= range.first && !room.take(sample.ByteSizeLong())) break;
    place = {range.job, range.run, place.count + 1, sample.step(), reader.offset()};
    if (place.count % kMarkEvery == 0) keep(place);
    if (place.count > range.first) out.samples.push_back(std::move(sample));
  }
  if (!out.is_cut) {
    keep(place);
  } else if (start.offset > 0) {
    // A worker has cut off reports that were damaged, and made others of the same samples.
    {
      const MutexLock lock(mutex_);
      std::erase_if(places_, [&](const Place& other) { return other.job == range.job; });
    }
    return read_log(path, range, room);
  }
  return out;
}

SampleReader::Place SampleReader::place_before(const SampleRange& range) {
  const MutexLock lock(mutex_);
  Place out{range.job, range.run};
  for (const Place& place : places_) {
    if (place.job == range.job && place.run == range.run && place.count <= range.first && place.count > out.count)
      out = place;
  }
  return out;
}

void SampleReader::keep(const Place& place) {
  const MutexLock lock(mutex_);
  std::erase_if(places_, [&](const Place& other) { return other.job == place.job && other.count == place.count; });
  places_.push_back(place);
  if (places_.size() > kMostPlaces) places_.pop_front();
}

SampleReader::Found SampleReader::read_result(const std::filesystem::path& path, const SampleRange& range,
                                              const v1::Summary& summary, PageRoom room) {
  const ResultReader result(path);
  std::shared_ptr<const Block> block;
  Found out;
  while (std::ssize(out.samples) < range.count) {
    const std::int64_t next = range.first + std::ssize(out.samples);
    const std::int64_t at = next % kBlockSamples;
    if (!block || at == 0) block = block_of(result, next - at);
    out.is_cut = at >= std::ssize(block->samples);
    if (out.is_cut) break;
    v1::Sample sample = block->samples[static_cast<std::size_t>(at)];
    add_warnings(summary, sample);
    if (!room.take(sample.ByteSizeLong())) break;
    out.samples.push_back(std::move(sample));
  }
  return out;
}

// Lists and watches of a job that has ended read it page by page, and comparisons again and again.
std::shared_ptr<const SampleReader::Block> SampleReader::block_of(const ResultReader& result, std::int64_t first) {
  const auto& file = result.file();
  const auto is_it = [&](const auto& block) { return block->file == file && block->first == first; };
  if (file) {
    const MutexLock lock(mutex_);
    const auto found = std::ranges::find_if(blocks_, is_it);
    if (found != blocks_.end()) return *found;
  }
  auto out =
      std::make_shared<const Block>(Block{file.value_or(FileIdentity{}), first, result.history(first, kBlockSamples)});
  const auto bytes = std::transform_reduce(out->samples.begin(), out->samples.end(), std::size_t{0}, std::plus<>(),
                                           [](const v1::Sample& sample) { return sample.ByteSizeLong(); });
  if (!file || bytes > kMostBlockBytes) return out;
  const MutexLock lock(mutex_);
  if (std::ranges::none_of(blocks_, is_it)) blocks_.push_back(out);
  if (blocks_.size() > kMostBlocks) blocks_.pop_front();
  return out;
}

}  // namespace cellcrush::store
