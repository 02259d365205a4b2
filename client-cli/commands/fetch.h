#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "columns/csv_text.h"
#include "commands/vtk_files.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// Throws CommandError (refused) if the folder contains somebody else's file with a name that write_results uses.
void check_may_write_results(const std::filesystem::path& folder);

/// Summary of what write_results did.
struct ResultFiles {
  std::vector<std::filesystem::path> written;
  std::vector<std::filesystem::path> removed;
};

/// What write_results writes beside its usual files, and how.
struct ResultForm {
  std::vector<double> frame_times;  ///< in s, of frames as CSV
  Decimal decimal = Decimal::point;
  std::optional<VtkKind> vtk;  ///< all frames
};

/// Writes into a folder, which it creates: case.txtpb, history.csv, nodes.csv if nodes are watched,
/// rigid_walls.csv and grips.csv if there are any, the frames that `form` asks for, and result.h5. No file appears
/// before all of them are on the disk; result.h5 appears last. Deletes the nodes.csv, rigid_walls.csv, grips.csv and
/// frames that it wrote for another job.
ResultFiles write_results(Connection& connection, const v1::Job& job, const std::filesystem::path& folder,
                          const ResultForm& form = {});

}  // namespace cellcrush::client
