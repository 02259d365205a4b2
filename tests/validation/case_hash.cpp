#include "store/case_hash.h"

#include "cellcrush/simulation.h"
#include "revision.h"
#include "translate/spec_to_case.h"
#include "validation/provenance.h"

namespace cellcrush::validation {

std::string case_hash_of(const SceneSpec& spec) {
  const SceneResult built = build_scene(spec);
  return built.scene ? store::hash_of(translate::to_case(complete_spec(spec, *built.scene))) : "";
}

std::string source_revision() { return kSourceRevision; }

}  // namespace cellcrush::validation
