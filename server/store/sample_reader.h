#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "mutex.h"
#include "store/page_room.h"
#include "store/result_reader.h"

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
  /// Where the reports of a job go on behind some samples.
  struct Place {
    std::int64_t job = 0;
    std::int64_t run = 0;
    std::int64_t count = 0;  ///< of the samples before
    std::int64_t step = -1;  ///< of the last one
    std::uint64_t offset = 0;
  };
  /// Samples of a result from number `first` on, as they stand there.
  struct Block {
    FileIdentity file{};
    std::int64_t first = 0;
    std::vector<v1::Sample> samples;
  };

  Found read_log(const std::filesystem::path& path, const SampleRange& range, PageRoom room);
  Place place_before(const SampleRange& range);
  void keep(const Place& place);
  Found read_result(const std::filesystem::path& path, const SampleRange& range, const v1::Summary& summary,
                    PageRoom room);
  std::shared_ptr<const Block> block_of(const ResultReader& result, std::int64_t first);

  std::filesystem::path root_;
  Mutex mutex_;
  std::deque<Place> places_ CELLCRUSH_GUARDED_BY(mutex_);  ///< where reading ended or passed, the latest last
  std::deque<std::shared_ptr<const Block>> blocks_ CELLCRUSH_GUARDED_BY(mutex_);  ///< decoded lately, the latest last
};

}  // namespace cellcrush::store
