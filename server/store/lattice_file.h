#pragma once

#include <filesystem>

#include "store/job_folder.h"
#include "store/report.pb.h"

namespace cellcrush::store {

// The large lattice of an order is a file of its own beside it, `lattice`: a hard link to a file that all jobs, or all
// attempts, with this lattice share (lattices/HASH beside jobs/ or attempts/), or a copy on file systems without links.

/// The order as its file is to have it, after its lattice, if large, is durably in the folder. An order without its
/// lattice, as its file has it, stays as it is. Throws the errors of throw_file_error.
worker::Order put_lattice_apart(const JobFolder& folder, worker::Order order);

/// Completes an order as its file has it. Throws ServiceError: data_loss if the lattice is missing or damaged.
void read_lattice_of(const JobFolder& folder, worker::Order& order);

/// Removes the files in `lattices` that no folder refers to any more. Does not throw.
void remove_unused_lattices(const std::filesystem::path& lattices);

}  // namespace cellcrush::store
