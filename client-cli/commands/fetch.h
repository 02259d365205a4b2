#pragma once

#include <filesystem>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// Throws CommandError (refused) where the folder holds another's file of a name that write_results writes.
void check_may_write_results(const std::filesystem::path& folder);

/// What write_results did in its folder.
struct ResultFiles {
  std::vector<std::filesystem::path> written;
  std::vector<std::filesystem::path> removed;
};

/// Writes a job's case.txtpb, history.csv, nodes.csv where it has nodes, the frames nearest to the times in s, and
/// result.h5 into a folder, which it makes. No file appears before all of them are on the disk; result.h5
/// appears last. Removes the nodes.csv and frames that it wrote for another job.
ResultFiles write_results(Connection& connection, const v1::Job& job, const std::filesystem::path& folder,
                          const std::vector<double>& frame_times = {});

}  // namespace cellcrush::client
