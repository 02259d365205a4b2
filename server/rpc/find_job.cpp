#include "rpc/find_job.h"

#include <optional>
#include <utility>

#include "error.h"
#include "rpc/request_limits.h"
#include "store/resource_name.h"

namespace cellcrush::rpc {

store::StoredJob find_job(store::JournalReader& journal, const std::string& name) {
  check_length("name", name, kLongestName);
  const auto number = store::number_of(name);
  auto stored = number ? journal.find_job(*number) : std::nullopt;
  if (!stored) {
    throw ServiceError(
        ServiceError::Kind::not_found,
        "There is no job \"" + name + "\". Job names look like jobs/12; ListJobs (`cellcrush list`) lists them.");
  }
  return *std::move(stored);
}

}  // namespace cellcrush::rpc
