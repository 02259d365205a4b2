#pragma once

#include <string>

#include "store/journal_reader.h"

namespace cellcrush::rpc {

/// The job with that name. Throws ServiceError (not_found) if there is none, and InvalidField if the name is too long.
store::StoredJob find_job(store::JournalReader& journal, const std::string& name);

}  // namespace cellcrush::rpc
