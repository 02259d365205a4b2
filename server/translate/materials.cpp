#include "translate/materials.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "translate/case_words.h"
#include "translate/presets.h"

namespace cellcrush::translate {
namespace {

v1::ListMaterialsResponse read_materials() {
  v1::ListMaterialsResponse out;
  if (!google::protobuf::TextFormat::ParseFromString(materials_text(), &out))
    throw std::logic_error("server/presets/materials.txtpb is no ListMaterialsResponse");
  for (v1::NamedMaterial& material : *out.mutable_materials()) material.set_numbers(material_text(material.material()));
  return out;
}

/// Null without a name. The list itself is read with this: its materials name none.
const v1::NamedMaterial* find_material(const std::string& name) {
  if (name.empty()) return nullptr;
  const auto& all = materials().materials();
  const auto found = std::ranges::find(all, name, [](const auto& named) { return named.name(); });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

bool is_named_material(const std::string& name) { return find_material(name) != nullptr; }

const v1::ListMaterialsResponse& materials() {
  static const v1::ListMaterialsResponse kMaterials = read_materials();
  return kMaterials;
}

std::string known_materials() {
  std::string names;
  for (const v1::NamedMaterial& material : materials().materials()) {
    names += (names.empty() ? "" : ", ") + ('"' + material.name() + '"');
  }
  return names;
}

v1::Material with_named(const v1::Material& material) {
  const v1::NamedMaterial* named = find_material(material.named());
  if (named == nullptr) return material;
  v1::Material out = named->material();
  // A table in place of what the named material has, not beside it.
  if (material.has_hardening_table()) {
    out.clear_hardening_table();
    out.clear_hardening_modulus_mpa();
    out.clear_voce_stress_mpa();
    out.clear_voce_exponent();
    out.clear_ludwik_stress_mpa();
    out.clear_ludwik_exponent();
    out.clear_yield_stress_mpa();
  }
  if (material.has_rate_table()) {
    out.clear_rate_table();
    out.clear_cowper_symonds_rate_per_s();
    out.clear_cowper_symonds_exponent();
    out.clear_johnson_cook_coefficient();
    out.clear_johnson_cook_reference_rate_per_s();
  }
  out.MergeFrom(material);
  return out;
}

v1::Case with_named_materials(v1::Case of) {
  if (of.has_material()) *of.mutable_material() = with_named(of.material());
  v1::Lattice& lattice = *of.mutable_lattice();
  if (lattice.has_frame()) {
    for (auto& beam : *lattice.mutable_frame()->mutable_beams()) {
      if (beam.has_material()) *beam.mutable_material() = with_named(beam.material());
    }
  }
  if (lattice.has_network()) {
    for (auto& material : *lattice.mutable_network()->mutable_materials()) material = with_named(material);
  }
  return of;
}

Problems notes_on_named(const v1::Case& of, Problems notes) {
  const v1::Material& given = of.material();
  const v1::NamedMaterial* named = find_material(given.named());
  if (named == nullptr) return notes;
  bool gives_all = true;
  bool differs = false;
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  named->material().GetReflection()->ListFields(named->material(), &fields);
  for (const auto* field : fields) {
    const bool is_given = given.GetReflection()->HasField(given, field);
    gives_all = gives_all && is_given;
    if (!is_given) std::erase_if(notes, [&](const Problem& note) { return note.field == "material." + field->name(); });
    differs = differs || (is_given && given.GetReflection()->GetDouble(given, field) !=
                                          named->material().GetReflection()->GetDouble(named->material(), field));
  }
  if (gives_all && differs) {
    notes.push_back({"material.named", given.named(),
                     "does not count: the case gives all of its numbers, others than it.",
                     "Clear the numbers that the name is to give, such as youngs_modulus_mpa."});
  }
  return notes;
}

}  // namespace cellcrush::translate
