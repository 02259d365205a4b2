#pragma once

#include <string>
#include <vector>

#include "chart/lattice_drawing.h"
#include "connection/frames.h"
#include "plots/job_curves.h"
#include "plots/rigid_walls.h"
#include "plots/sweep_curves.h"

namespace cellcrush::client {

/// Pictures of a width in print have no title, which a caption has, and their charts are higher for their width.

/// What a drawing shows of a frame.
LatticeStage lattice_stage(const MeshFrame& frame, const RigidWalls& rigid_walls = {});

/// The picture of one job: the lattice at each of `stages` (may be empty), at one scale, above its curves. For a crush
/// these are the stresses and the energy ledger, which a page in print without room for it lacks.
std::string render_job_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& stages,
                               const PrintSize& print = {});

/// The same with the lattice to the left of the stress curves and without the ledger, for a slide. REQUIRES: stages is
/// not empty.
std::string render_wide_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& stages,
                                const PrintSize& print = {});

/// The stages alone, without a title, for a figure with a caption. REQUIRES: stages is not empty.
std::string render_stages_picture(PictureFormat format, const std::vector<MeshFrame>& stages,
                                  const RigidWalls& rigid_walls = {}, const PrintSize& print = {});

/// The picture of several jobs, or of jobs and tests: their curves over common axes.
std::string render_comparison_picture(PictureFormat format, const std::vector<JobHistory>& histories,
                                      const PrintSize& print = {}, const TestOverlay& test = {});

/// Forces of jobs over a displacement, and a test.
std::string render_force_picture(PictureFormat format, const std::vector<v1::Job>& jobs,
                                 const std::vector<v1::CompareTestResponse>& forces, const std::string& subtitle,
                                 const PrintSize& print, const TestOverlay& test);

/// The picture of one or several sweeps: plateau stress against the varied field, or, for one sweep over two fields and
/// unless `series`, as a map over both. REQUIRES: at least one sweep.
std::string render_sweep_picture(PictureFormat format, const std::vector<SweepResults>& sweeps,
                                 const LogarithmicAxes& logarithmic, bool series = false, const PrintSize& print = {});

/// A frame of a movie as PNG: the lattice inside `box` with strain and time above it. All frames of one box have the
/// same size, with even numbers of pixels, as video encoders require.
std::string render_movie_frame(const LatticeStage& stage, const Box& box);

}  // namespace cellcrush::client
