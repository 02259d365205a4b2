#pragma once

#include <string>
#include <vector>

#include "chart/job_curves.h"
#include "chart/sweep_curves.h"
#include "connection/frames.h"

namespace cellcrush::client {

/// The picture of one job: the lattice at each of `stages` (may be empty), all at one scale, above its curves; of a
/// crush these are the stresses and the ledger.
std::string render_job_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& stages);

/// The same with the lattice left of the stress curves and without the ledger, as a slide needs it. REQUIRES: stages is
/// not empty.
std::string render_wide_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& stages);

/// The stages alone, without a title, as a figure with a caption needs them. REQUIRES: stages is not empty.
std::string render_stages_picture(PictureFormat format, const std::vector<MeshFrame>& stages);

/// The picture of several jobs: their curves over common axes.
std::string render_comparison_picture(PictureFormat format, const std::vector<JobHistory>& histories);

/// The picture of one or several sweeps: plateau stress against what is varied. REQUIRES: there is one.
std::string render_sweep_picture(PictureFormat format, const std::vector<SweepResults>& sweeps,
                                 const LogarithmicAxes& logarithmic);

}  // namespace cellcrush::client
