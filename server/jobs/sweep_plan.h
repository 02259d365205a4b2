#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cellcrush/v1/problem.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "jobs/mesh_places.h"
#include "store/journal.h"

namespace cellcrush::jobs {

/// Makes the jobs of a sweep's points.
class JobMaker;

/// The jobs of a sweep, which outlives it, or the problems of its points.
struct SweepPlan {
  std::shared_ptr<const JobMaker> maker;  ///< of the jobs
  std::vector<store::SweepJob> jobs;   ///< in the order of the points; complete only without problems
  std::int64_t most_memory_bytes = 0;  ///< upper bound of the largest job's memory; 0 with problems
  std::size_t largest = 0;             ///< index of that job
  google::protobuf::RepeatedPtrField<v1::Problem> problems;  ///< shared ones are merged
  google::protobuf::RepeatedPtrField<v1::Problem> notes;     ///< merged likewise; empty with problems
};

/// Options for checking the points of a sweep.
struct PointChecking {
  MeshPlaces& places;
  int threads = 1;                 ///< at least one; does not affect the plan
  std::function<bool()> given_up;  ///< whether the caller no longer waits; called from every thread
  std::string executor = {};       ///< of the jobs
};

/// Creates the case of every point, with its values in the title, and checks it as CheckCase does. Throws InvalidField
/// for an invalid sweep, and ServiceError (cancelled) once `given_up` returns true.
SweepPlan plan_sweep(const v1::Sweep& sweep, const PointChecking& checking);

}  // namespace cellcrush::jobs
