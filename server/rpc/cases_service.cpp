#include "rpc/cases_service.h"

#include <string>

#include "error_table.h"
#include "rpc/request_fields.h"
#include "store/result_writer.h"
#include "translate/case_checker.h"
#include "translate/check_case.h"
#include "translate/measured_errors.h"
#include "translate/presets.h"

namespace cellcrush::rpc {
namespace {

constexpr std::size_t kLargestPreview = 3'000'000;  // bytes

std::string known_presets() {
  std::string out;
  for (const auto& [preset, spec] : translate::presets()) out += (out.empty() ? "" : ", ") + preset.name();
  return out;
}

}  // namespace

grpc::Status CasesService::check_case(const Call& call, const v1::CheckCaseRequest& request,
                                      v1::CheckCaseResponse& response) {
  const auto elements = translate::CaseChecker().elements_to_build(request.case_());
  const jobs::MeshPlaces::Place place(parts_.places, elements, [&call] { return call.is_cancelled(); });
  const auto look_up = [&call] {
    if (call.is_cancelled()) throw ServiceError(ServiceError::Kind::cancelled, "The client cancelled the call.");
  };
  auto check = translate::check_case(request.case_(), look_up);
  v1::CheckCaseResponse& out = check.response;
  if (out.problems_size() == 0) {
    out.set_predicted_seconds(parts_.step_cost * static_cast<double>(out.element_count()) *
                              static_cast<double>(out.step_count()));
    translate::add_fidelities(request.case_(), parts_.step_cost, check);
    out.set_predicted_bytes(store::predicted_result_bytes(out.particle_count(), out.element_count(), check.sample_count,
                                                          check.frame_count));
  }
  response = std::move(out);
  return grpc::Status::OK;
}

grpc::Status CasesService::preview_case(const Call& call, const v1::PreviewCaseRequest& request,
                                        v1::PreviewCaseResponse& response) {
  check_size("case", request.case_().ByteSizeLong(), kLargestCase);
  const auto elements = translate::CaseChecker().elements_to_build(request.case_());
  const jobs::MeshPlaces::Place place(parts_.places, elements, [&call] { return call.is_cancelled(); });
  auto preview = translate::preview_case(request.case_());
  if (!preview.problems.empty()) return status_of(preview.problems);
  if (preview.mesh.ByteSizeLong() > kLargestPreview) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       "The mesh of the case has " + std::to_string(preview.mesh.element_nodes_size() / 2) +
                           " elements, more than a preview can hold. Preview it with fewer cells or with "
                           "elements_per_wall 1.");
  }
  *response.mutable_mesh() = std::move(preview.mesh);
  return grpc::Status::OK;
}

grpc::Status CasesService::list_presets(const Call&, const v1::ListPresetsRequest&, v1::ListPresetsResponse& response) {
  for (const auto& [preset, spec] : translate::presets()) {
    v1::Preset& listed = *response.add_presets() = preset;
    listed.clear_case_();
  }
  return grpc::Status::OK;
}

grpc::Status CasesService::get_preset(const Call&, const v1::GetPresetRequest& request, v1::Preset& response) {
  check_length("name", request.name(), kLongestName);
  const translate::Preset* preset = translate::find_preset(request.name());
  if (preset == nullptr) {
    throw ServiceError(ServiceError::Kind::not_found,
                       "There is no preset \"" + request.name() + "\". Available presets: " + known_presets() + ".");
  }
  response = preset->message;
  return grpc::Status::OK;
}

void CasesService::add_methods(MethodTable& table) {
  using access::Scope;
  table.unary("/cellcrush.v1.Cases/CheckCase", Scope::read, &parts_.checks, *this, &CasesService::check_case);
  table.unary("/cellcrush.v1.Cases/PreviewCase", Scope::read, &parts_.checks, *this, &CasesService::preview_case);
  table.unary("/cellcrush.v1.Cases/ListPresets", Scope::read, &parts_.calls, *this, &CasesService::list_presets);
  table.unary("/cellcrush.v1.Cases/GetPreset", Scope::read, &parts_.calls, *this, &CasesService::get_preset);
}

}  // namespace cellcrush::rpc
