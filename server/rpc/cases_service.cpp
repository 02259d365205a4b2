#include <memory>
#include <string>

#include "drawing/drawing.h"
#include "drawing/import_lattice.h"
#include "error_table.h"
#include "rpc/request_fields.h"
#include "rpc/services.h"
#include "store/result_writer.h"
#include "translate/case_checker.h"
#include "translate/check_case.h"
#include "translate/materials.h"
#include "translate/measured_errors.h"
#include "translate/presets.h"
#include "translate/preview_case.h"

namespace cellcrush::rpc {
namespace {

constexpr std::size_t kLargestOfSmallDrawings = 100'000;  // bytes, which take milliseconds
constexpr std::size_t kLongestFileName = 255;

std::size_t size_of_files(const v1::ImportLatticeRequest& request) {
  std::size_t bytes = 0;
  for (const auto& file : request.files()) bytes += file.content().size();
  return bytes;
}

std::string known_presets() {
  std::string out;
  for (const auto& [preset, spec] : translate::presets()) out += (out.empty() ? "" : ", ") + preset.name();
  return out;
}

/// The calls of Cases, which answers questions about cases. Thread-safe.
class CaseCalls {
 public:
  explicit CaseCalls(const ServiceParts& parts) : parts_(parts) {}

  v1::CheckCaseResponse check_case(const Call& call, const v1::CheckCaseRequest& request) {
    const auto place = take_place(call, request.case_());
    auto check = translate::check_case(request.case_(), [&call] { call.require_wanted(); });
    v1::CheckCaseResponse& out = check.response;
    if (out.problems_size() > 0) return std::move(out);
    out.set_predicted_seconds(parts_.step_cost * check.reference_steps);
    translate::add_fidelities(request.case_(), parts_.step_cost, check);
    if (parts_.has_device) {
      out.add_modelled(check.why_not_on_device
                           ? "Device: does not advance this run, because " + *check.why_not_on_device + "."
                           : "Device: advances this run, to the bits of the processor.");
    }
    out.set_predicted_bytes(store::predicted_result_bytes(out.particle_count(), out.element_count(), check.wall_count,
                                                          check.sample_count, check.frame_count));
    // While it runs, a job has its newest checkpoint, the one before and the one being written.
    constexpr std::int64_t kCheckpoints = 3;
    out.set_predicted_disk_bytes(out.predicted_bytes() + kCheckpoints * check.checkpoint_bytes +
                                 store::predicted_report_bytes(out.particle_count(), out.element_count(),
                                                               check.wall_count, check.sample_count,
                                                               check.frame_count));
    return std::move(out);
  }

  v1::PreviewCaseResponse preview_case(const Call& call, const v1::PreviewCaseRequest& request) {
    check_size("case", request.case_().ByteSizeLong(), kLargestCase);
    const auto place = take_place(call, request.case_());
    auto preview = translate::preview_case(request.case_(), [&call] { call.require_wanted(); });
    if (!preview.has_mesh()) throw RefusedCase(preview.problems());
    if (preview.mesh().ByteSizeLong() > translate::kLargestPreview) {
      throw ServiceError(ServiceError::Kind::exhausted,
                         "The mesh of the case has " + std::to_string(preview.mesh().element_nodes_size() / 2) +
                             " elements even with elements_per_wall 1, more than a preview can hold. Preview it "
                             "with fewer cells.");
    }
    return preview;
  }

  v1::ImportLatticeResponse import_lattice(const Call&, const v1::ImportLatticeRequest& request) {
    check_size("files", size_of_files(request), kLargestCase);
    for (const auto& file : request.files()) check_length("files.name", file.name(), kLongestFileName);
    check_length("unit", request.unit(), kLongestName);
    try {
      auto out = drawing::import_lattice(request);
      check_size("network", out.network().ByteSizeLong(), kLargestCase);
      return out;
    } catch (const drawing::DrawingError& error) {
      throw ServiceError(ServiceError::Kind::invalid, error.what());
    }
  }

  v1::ListPresetsResponse list_presets(const Call&, const v1::ListPresetsRequest&) {
    v1::ListPresetsResponse out;
    for (const auto& [preset, spec] : translate::presets()) (*out.add_presets() = preset).clear_case_();
    return out;
  }

  v1::Preset get_preset(const Call&, const v1::GetPresetRequest& request) {
    check_length("name", request.name(), kLongestName);
    const translate::Preset* preset = translate::find_preset(request.name());
    if (preset == nullptr) {
      throw ServiceError(ServiceError::Kind::not_found,
                         "There is no preset \"" + request.name() + "\". Available presets: " + known_presets() + ".");
    }
    return preset->message;
  }

  v1::ListMaterialsResponse list_materials(const Call&, const v1::ListMaterialsRequest&) {
    return translate::materials();
  }

 private:
  /// For the mesh of the case.
  jobs::MeshPlaces::Place take_place(const Call& call, const v1::Case& submitted) const {
    return {parts_.places, translate::CaseChecker().elements_to_build(submitted),
            [&call] { return call.is_cancelled(); }};
  }

  const ServiceParts& parts_;
};

}  // namespace

bool is_large_case(const v1::Case& submitted) {
  return translate::CaseChecker().elements_to_build(submitted) > jobs::MeshPlaces::kMostOfSmall;
}

void add_cases_methods(MethodTable& table, const ServiceParts& parts) {
  using access::Scope;
  const auto calls = std::make_shared<CaseCalls>(parts);
  const auto is_large = [](const auto& request) { return is_large_case(request.case_()); };
  table.unary("/cellcrush.v1.Cases/CheckCase", Scope::read, &parts.checks, calls, &CaseCalls::check_case, is_large);
  table.unary("/cellcrush.v1.Cases/PreviewCase", Scope::read, &parts.checks, calls, &CaseCalls::preview_case, is_large);
  const auto is_long = [](const auto& request) { return size_of_files(request) > kLargestOfSmallDrawings; };
  table.unary("/cellcrush.v1.Cases/ImportLattice", Scope::read, &parts.checks, calls, &CaseCalls::import_lattice,
              is_long);
  table.unary("/cellcrush.v1.Cases/ListPresets", Scope::read, &parts.calls, calls, &CaseCalls::list_presets);
  table.unary("/cellcrush.v1.Cases/GetPreset", Scope::read, &parts.calls, calls, &CaseCalls::get_preset);
  table.unary("/cellcrush.v1.Cases/ListMaterials", Scope::read, &parts.calls, calls, &CaseCalls::list_materials);
}

}  // namespace cellcrush::rpc
