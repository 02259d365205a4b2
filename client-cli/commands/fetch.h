#pragma once

#include <filesystem>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// Throws CommandError (refused) if the folder contains somebody else's file with a name that write_results uses.
void check_may_write_results(const std::filesystem::path& folder);

/// Summary of what write_results did.
struct ResultFiles {
  std::vector<std::filesystem::path> written;
  std::vector<std::filesystem::path> removed;
};

/// Writes into a folder, which it creates: case.txtpb, history.csv, nodes.csv if nodes are watched,
/// rigid_walls.csv if there are any, the frames nearest to the times in s, and result.h5. No file appears before all of
/// them are on the disk; result.h5 appears last. Deletes the nodes.csv, rigid_walls.csv and frames that it wrote for
/// another job.
ResultFiles write_results(Connection& connection, const v1::Job& job, const std::filesystem::path& folder,
                          const std::vector<double>& frame_times = {});

}  // namespace cellcrush::client
