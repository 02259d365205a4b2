#include "worker/origin.h"

#include "cellcrush/simd.h"
#include "revision.h"
#include "store/case_hash.h"
#include "worker/report_log.h"

namespace cellcrush::worker {

Checkpoint::Origin origin_of(const Order& order) {
  Checkpoint::Origin out;
  out.set_solver_revision(kSolverIdentity);
  out.set_simd_target(simd_target());
  out.set_case_hash(store::hash_of(order.case_()));
  return out;
}

std::optional<Checkpoint::Origin> find_other_origin(const store::JobFolder& folder, const Checkpoint::Origin& origin) {
  ReportLogReader reader(folder.reports());
  const std::string own = origin.SerializeAsString();
  Report report;
  while (reader.read(report) == ReportLogReader::Read::message) {
    if (report.has_begun() && report.begun().origin().SerializeAsString() != own) return report.begun().origin();
  }
  return std::nullopt;
}

}  // namespace cellcrush::worker
