#include "jobs/housekeeping.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "error.h"
#include "jobs/deletion.h"
#include "jobs/resource_name.h"

namespace cellcrush::jobs {
namespace {

constexpr int kAtOnce = 200;  // jobs

}  // namespace

void Housekeeping::work(const std::stop_token& stop) {
  std::mutex never_shared;
  std::condition_variable_any sleep;
  while (!stop.stop_requested()) {
    try {
      look_at_disk();
      delete_old_jobs();
    } catch (const std::exception& error) {
      spdlog::error("Housekeeping failed, and is tried again: {}", error.what());
    }
    std::unique_lock lock(never_shared);
    sleep.wait_for(lock, stop, parts_.interval, [] { return false; });
  }
}

void Housekeeping::look_at_disk() {
  const bool has_room = parts_.admission.has_room();
  if (parts_.scheduler.hold(!has_room)) {
    has_room ? spdlog::info("The disk has room again: jobs go on")
             : spdlog::warn("The disk has {} MiB left: running jobs are left at a checkpoint, and none starts",
                            parts_.folder.free_bytes() / (1024 * 1024));
  }
  if (has_room) parts_.folder.keep_ballast();
}

void Housekeeping::delete_old_jobs() {
  if (parts_.keep_ended_jobs.count() == 0) return;
  using google::protobuf::util::TimeUtil;
  const std::int64_t limit = TimeUtil::TimestampToSeconds(TimeUtil::GetCurrentTime()) - parts_.keep_ended_jobs.count();
  for (const v1::JobState state : {v1::SUCCEEDED, v1::FAILED, v1::CANCELLED}) {
    std::int64_t last = 0;
    while (true) {
      const auto jobs = parts_.reader.list_jobs({{state}, {}, {}, {}}, false, last, kAtOnce);
      for (const auto& stored : jobs) {
        last = stored.number;
        if (TimeUtil::TimestampToSeconds(stored.job.end_time()) >= limit) continue;
        delete_job(stored.number, parts_.journal, parts_.folder);
        spdlog::info("{} ended long ago and is deleted", stored.job.name());
      }
      if (jobs.size() < kAtOnce) break;
    }
  }
}

}  // namespace cellcrush::jobs
