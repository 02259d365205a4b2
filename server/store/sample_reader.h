#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "mutex.h"
#include "store/page_room.h"

namespace cellcrush::store {

/// Consecutive samples of a job, counted from 0.
struct SampleRange {
  std::int64_t job = 0;
  std::int64_t run = 0;  ///< number of the event with which the job last began again; 0: it never did
  std::int64_t first = 0;
  std::int64_t count = 0;
};

/// Reads samples where they are: in the reports of a job's workers, in its `history`, or in its result. Thread-safe.
class SampleReader {
 public:
  /// `root`: the data folder.
  explicit SampleReader(std::filesystem::path root) : root_(std::move(root)) {}

  struct Found {
    std::vector<v1::Sample> samples;
    bool is_cut = false;  ///< the next one is missing or unreadable
  };
  /// As many of the range as there is room for. `summary`: of the job, whose warnings a result does not repeat by
  /// sample. Throws ServiceError if the file with them cannot be read.
  Found read(const SampleRange& range, const v1::Summary& summary, PageRoom room = {});

 private:
  /// Where the reports go on behind some samples.
  struct Place {
    std::int64_t count = 0;  ///< of the samples before
    std::int64_t step = -1;  ///< of the last one
    std::uint64_t offset = 0;
  };
  /// Of a job's reports.
  struct Places {
    std::int64_t run = 0;
    std::vector<Place> marks;  ///< at least kMarkEvery samples apart
    Place newest;
    std::uint64_t turn = 0;  ///< when they were last used
  };
  static constexpr std::int64_t kMarkEvery = 256;
  static constexpr std::size_t kMostJobs = 64;

  Found read_log(const std::filesystem::path& path, const SampleRange& range, PageRoom room);
  Place place_before(const SampleRange& range);
  void keep(const SampleRange& range, const std::vector<Place>& marks, const Place& newest);

  std::filesystem::path root_;
  Mutex mutex_;
  std::map<std::int64_t, Places> places_ CELLCRUSH_GUARDED_BY(mutex_);  ///< by job
  std::uint64_t turn_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
};

}  // namespace cellcrush::store
