#pragma once

#include <filesystem>
#include <string>

#include "slurm/cluster_options.h"

namespace cellcrush::slurm {

/// Prepares the folder of a cluster for the daemon with this data folder: a marker in both says that they belong
/// together. Removes what earlier daemons left of attempts that no job names. Throws ServiceError
/// (failed_precondition) if the folder belongs to another daemon or lacks its marker, as when its file system is not
/// mounted.
void prepare_shared_folder(const ClusterOptions& options, const std::filesystem::path& data_folder);

/// Throws ServiceError, with a shortage, unless the marker is there.
void require_marker(const std::filesystem::path& folder);

}  // namespace cellcrush::slurm
