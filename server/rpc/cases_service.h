#pragma once

#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "jobs/mesh_places.h"
#include "rpc/call_pool.h"

namespace cellcrush::rpc {

/// Answers questions about cases. Thread-safe.
class CasesService final : public v1::Cases::CallbackService {
 public:
  /// `step_cost`: seconds of one core per element and step. `checks` runs calls that may take seconds, so that the
  /// others need not wait for them. Both pools and the places outlive it.
  CasesService(double step_cost, CallPool& calls, CallPool& checks, jobs::MeshPlaces& places)
      : step_cost_(step_cost), calls_(calls), checks_(checks), places_(places) {}

  grpc::ServerUnaryReactor* CheckCase(grpc::CallbackServerContext* context, const v1::CheckCaseRequest* request,
                                      v1::CheckCaseResponse* response) override;
  grpc::ServerUnaryReactor* PreviewCase(grpc::CallbackServerContext* context, const v1::PreviewCaseRequest* request,
                                        v1::PreviewCaseResponse* response) override;
  grpc::ServerUnaryReactor* ListPresets(grpc::CallbackServerContext* context, const v1::ListPresetsRequest* request,
                                        v1::ListPresetsResponse* response) override;
  grpc::ServerUnaryReactor* GetPreset(grpc::CallbackServerContext* context, const v1::GetPresetRequest* request,
                                      v1::Preset* response) override;

 private:
  double step_cost_;
  CallPool& calls_;
  CallPool& checks_;
  jobs::MeshPlaces& places_;
};

}  // namespace cellcrush::rpc
