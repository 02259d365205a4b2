#pragma once

#include <string>
#include <vector>

#include "chart/job_curves.h"
#include "connection/frames.h"

namespace cellcrush::client {

/// The picture of one job: the lattice at each of `stages` (may be empty), all at one scale, above its stress-strain
/// curve. Wide lattices stand one above the other, others side by side.
std::string render_job_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& stages);

/// The picture of several jobs: their curves over common axes.
std::string render_comparison_picture(PictureFormat format, const std::vector<JobHistory>& histories);

}  // namespace cellcrush::client
