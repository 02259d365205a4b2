#pragma once

#include "cellcrush/v1/cases_service.pb.h"
#include "jobs/mesh_places.h"
#include "rpc/method_table.h"

namespace cellcrush::rpc {

/// Answers questions about cases. Thread-safe.
class CasesService {
 public:
  /// `step_cost`: seconds of one core per element and step. `checks` runs calls that may take seconds, so that the
  /// others need not wait for them. Both pools and the places outlive it.
  CasesService(double step_cost, CallPool& calls, CallPool& checks, jobs::MeshPlaces& places)
      : step_cost_(step_cost), calls_(calls), checks_(checks), places_(places) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  grpc::Status check_case(const Call& call, const v1::CheckCaseRequest& request, v1::CheckCaseResponse& response);
  grpc::Status preview_case(const Call& call, const v1::PreviewCaseRequest& request, v1::PreviewCaseResponse& response);
  grpc::Status list_presets(const Call&, const v1::ListPresetsRequest&, v1::ListPresetsResponse& response);
  grpc::Status get_preset(const Call&, const v1::GetPresetRequest& request, v1::Preset& response);

  double step_cost_;
  CallPool& calls_;
  CallPool& checks_;
  jobs::MeshPlaces& places_;
};

}  // namespace cellcrush::rpc
