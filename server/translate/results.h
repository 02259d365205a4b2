#pragma once

#include <array>
#include <cstdint>

#include "cellcrush/sample.h"
#include "cellcrush/simulation.h"
#include "cellcrush/stage.h"
#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::translate {

// What a run gives, as it goes over the wire. The solver's N mm is the wire's mJ; all other units are the same.

/// Why a run that stopped by itself failed; JOB_CAUSE_UNSPECIFIED when it did not.
v1::Job::Cause cause_of(RunStatus::Kind kind);

/// `scene`: the case, whose ids watched nodes and rigid walls have.
v1::Sample to_proto(const Sample& sample, const v1::Case& scene);
v1::FieldFrame to_proto(const FieldFrame& frame);
v1::Mesh to_proto(const MeshView& mesh);
v1::Theory to_proto(const Theory& theory);
/// Adds the elastic moduli of the lattice of a spec, if they are known. REQUIRES: a spec without problems.
void add_moduli(const SceneSpec& spec, v1::Theory& out);

/// Processor time of a run, s; the solver has no clock.
struct RunTime {
  double processor = 0.0;
  std::array<double, kStageCount> stages{};  ///< in the order of kStageNames
};
/// `last`: the last sample of the run, for the ledger; `scene`: as above.
v1::Summary to_proto(const Summary& summary, const Sample& last, const RunTime& time, const v1::Case& scene);

}  // namespace cellcrush::translate
