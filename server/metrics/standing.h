#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace cellcrush::metrics {

/// What is measured when it is asked for: the queue, the disk and the owners now.
struct Standing {
  struct Owner {
    std::size_t waiting = 0;  ///< jobs
    std::size_t running = 0;
    std::int64_t bytes = 0;  ///< journal rows, and results of ended jobs
  };

  double queue_age_s = 0.0;  ///< for which a job has waited in this daemon, at most
  std::int64_t free_disk_bytes = 0;
  std::int64_t kept_disk_bytes = 0;  ///< below which no job starts
  std::map<std::string, Owner> owners{};
  std::map<std::string, std::int64_t> behind{};  ///< changes that a receiver of notices has not seen, by its name
};

}  // namespace cellcrush::metrics
