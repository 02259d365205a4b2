#include "worker/origin.h"

#include <stdexcept>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "revision.h"
#include "store/case_hash.h"
#include "store/report_log.h"
#include "translate/case_to_spec.h"

namespace cellcrush::worker {

std::shared_ptr<const Scene> scene_of(const Order& order) {
  const auto reading = translate::to_spec(order.case_());
  auto built = build_scene(reading.spec);
  Problems problems = reading.problems;
  problems.insert(problems.end(), built.problems.begin(), built.problems.end());
  // The daemon has checked the case, so this is an old job that the present version rejects.
  if (!problems.empty()) {
    throw std::runtime_error("this version no longer accepts the case: " + problems.front().field + ": " +
                             problems.front().message);
  }
  return built.scene;
}

Checkpoint::Origin origin_of(const Order& order) {
  Checkpoint::Origin out;
  out.set_solver_revision(kSolverIdentity);
  out.set_simd_target(simd_target());
  out.set_case_hash(store::hash_of(order.case_()));
  return out;
}

std::optional<Checkpoint::Origin> find_other_origin(const store::JobFolder& folder, const Checkpoint::Origin& origin) {
  store::ReportLogReader reader(folder.reports());
  const std::string own = origin.SerializeAsString();
  Report report;
  while (reader.read(report) == store::ReportLogReader::Read::message) {
    if (report.has_begun() && report.begun().origin().SerializeAsString() != own) return report.begun().origin();
  }
  return std::nullopt;
}

}  // namespace cellcrush::worker
