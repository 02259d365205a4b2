#pragma once

#include <cstdint>
#include <string>

namespace cellcrush::notices {

/// Something that happened, as receivers are told.
struct Notice {
  std::string id;        ///< the same if it is told again
  std::string type;      ///< of kTypes
  std::string resource;  ///< "jobs/3", "sweeps/2"; the executor of a queue
  std::string body;      ///< JSON: {"type", "timestamp", "data"}
  std::int64_t job = 0;  ///< that has ended; 0: none
};

}  // namespace cellcrush::notices
