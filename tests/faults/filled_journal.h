#pragma once

#include <cstdint>
#include <filesystem>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::testing {

/// Makes a data folder whose journal has `count` PENDING jobs of the case, numbered from 1, as CreateJob leaves them.
void fill_journal(const std::filesystem::path& data_folder, std::int64_t count, const v1::Case& submitted);

}  // namespace cellcrush::testing
