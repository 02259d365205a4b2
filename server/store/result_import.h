#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::store {

/// How an imported job gets the file of its result.
enum class Import { copy, link };

/// Adds an ended job for each result to a data folder that no daemon uses, all or none, and returns their numbers, in
/// order. `files`: result.h5, under any name, or folders that contain one. `link`: the jobs refer to the files in
/// place, which must stay there. Throws ServiceError: with a line for each file that is no result, and the errors of
/// DataFolder and Journal.
std::vector<std::int64_t> import_results(const std::filesystem::path& data_folder,
                                         const std::vector<std::filesystem::path>& files, Import how);

}  // namespace cellcrush::store
