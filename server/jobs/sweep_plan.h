#pragma once

#include <functional>
#include <vector>

#include "cellcrush/v1/problem.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "jobs/mesh_places.h"
#include "store/journal.h"

namespace cellcrush::jobs {

/// The jobs that a sweep asks for, or what is wrong with its points.
struct SweepPlan {
  std::vector<store::SweepJob> jobs;   ///< in the order of the points; complete only without problems
  std::int64_t most_memory_bytes = 0;  ///< that one of the jobs needs, at most; 0 with problems
  std::size_t largest = 0;             ///< that job's place among them
  google::protobuf::RepeatedPtrField<v1::Problem> problems;  ///< those that several points share are one
  google::protobuf::RepeatedPtrField<v1::Problem> notes;     ///< likewise; none with problems
};

/// How the points of a sweep are checked.
struct PointChecking {
  MeshPlaces& places;
  int threads = 1;                 ///< at least one; the plan does not depend on it
  std::function<bool()> given_up;  ///< whether nobody waits for the plan any more; called from every thread
};

/// Makes the case of every point, with the values in its title, and checks it as CheckCase does. Throws InvalidField
/// when the sweep itself cannot be right, and ServiceError (cancelled) once it is given up.
SweepPlan plan_sweep(const v1::Sweep& sweep, const PointChecking& checking);

}  // namespace cellcrush::jobs
