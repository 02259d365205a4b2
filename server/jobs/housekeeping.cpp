#include "jobs/housekeeping.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

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
  std::string logged;
  while (!stop.stop_requested()) {
    try {
      look_at_disk();
      delete_old_jobs();
      logged.clear();
    } catch (const std::exception& error) {
      if (std::exchange(logged, error.what()) != error.what())
        spdlog::error("Housekeeping failed, and is tried again: {}", error.what());
    }
    std::unique_lock lock(never_shared);
    sleep.wait_for(lock, stop, parts_.interval, [] { return false; });
  }
}

void Housekeeping::look_at_disk() {
  const auto shortage = parts_.admission.low_disk();
  parts_.scheduler.hold_for_low_disk(shortage);
  if (!shortage) parts_.folder.keep_ballast();
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
