#pragma once

#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "rpc/large_checks.h"

namespace cellcrush::rpc {

/// Answers questions about cases. Thread-safe.
class CasesService final : public v1::Cases::Service {
 public:
  /// `step_cost`: seconds of one core for a step of an element.
  explicit CasesService(double step_cost) : step_cost_(step_cost) {}

  grpc::Status CheckCase(grpc::ServerContext* context, const v1::CheckCaseRequest* request,
                         v1::CheckCaseResponse* response) override;
  grpc::Status ListPresets(grpc::ServerContext* context, const v1::ListPresetsRequest* request,
                           v1::ListPresetsResponse* response) override;
  grpc::Status GetPreset(grpc::ServerContext* context, const v1::GetPresetRequest* request,
                         v1::Preset* response) override;

 private:
  double step_cost_;
  LargeChecks large_checks_;
};

}  // namespace cellcrush::rpc
