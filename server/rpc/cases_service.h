#pragma once

#include "cellcrush/v1/cases_service.pb.h"
#include "rpc/service_parts.h"

namespace cellcrush::rpc {

/// Answers questions about cases. Thread-safe.
class CasesService {
 public:
  explicit CasesService(const ServiceParts& parts) : parts_(parts) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  grpc::Status check_case(const Call& call, const v1::CheckCaseRequest& request, v1::CheckCaseResponse& response);
  grpc::Status preview_case(const Call& call, const v1::PreviewCaseRequest& request, v1::PreviewCaseResponse& response);
  grpc::Status list_presets(const Call&, const v1::ListPresetsRequest&, v1::ListPresetsResponse& response);
  grpc::Status get_preset(const Call&, const v1::GetPresetRequest& request, v1::Preset& response);

  ServiceParts parts_;
};

}  // namespace cellcrush::rpc
