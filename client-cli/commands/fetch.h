#pragma once

#include <filesystem>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// Throws CommandError (refused) where the folder holds another's file of a name that write_results writes.
void check_may_write_results(const std::filesystem::path& folder);

/// Writes a job's case.txtpb, history.csv, nodes.csv where it has nodes, the frames nearest to the times in s, and
/// result.h5 into a folder, which it makes. Each file appears whole. Returns their paths.
std::vector<std::filesystem::path> write_results(Connection& connection, const v1::Job& job,
                                                 const std::filesystem::path& folder,
                                                 const std::vector<double>& frame_times = {});

}  // namespace cellcrush::client
