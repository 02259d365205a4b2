#include "cellcrush/sample_bytes.h"

#include <cstdint>

#include "cellcrush/byte_stream.h"

namespace cellcrush {
namespace {

/// Calls visitor(field) for every field that is stored on its own; S is Sample or const Sample.
template <class S, class Visitor>
void visit_plain_fields(S& sample, Visitor&& visitor) {
  visitor(sample.step);
  visitor(sample.time);
  visitor(sample.travel);
  visitor(sample.strain);
  visitor(sample.stress_impact);
  visitor(sample.stress_support);
  visitor(sample.energy_kinetic);
  visitor(sample.energy_elastic);
  visitor(sample.energy_plastic);
  visitor(sample.energy_contact);
  visitor(sample.energy_friction);
  visitor(sample.energy_damping);
  visitor(sample.work_external);
  visitor(sample.energy_residual);
  visitor(sample.energy_contact_stored);
  visitor(sample.energy_contact_damping);
  visitor(sample.deepest_penetration);
  visitor(sample.contact_count);
  visitor(sample.walls_crossed);
  visitor(sample.solid_fraction);
  visitor(sample.collapsed_fraction);
  visitor(sample.crush_mode);
  visitor(sample.watched);
}

template <class W, class Visitor>
void visit_warning(W& warning, Visitor&& visitor) {
  visitor(warning.kind);
  visitor(warning.step);
  visitor(warning.strain);
  visitor(warning.message);
  visitor(warning.remedy);
}

void put(ByteWriter& writer, const Sample& sample) {
  const auto put_field = [&writer](const auto& field) { writer.put(field); };
  visit_plain_fields(sample, put_field);
  writer.put(sample.front.has_value());
  if (sample.front) writer.put(*sample.front);
  writer.put(std::uint64_t{sample.warnings.size()});
  for (const Warning& warning : sample.warnings) visit_warning(warning, put_field);
}

Sample take(ByteReader& reader) {
  Sample sample;
  const auto take_field = [&reader](auto& field) { reader.take(field); };
  visit_plain_fields(sample, take_field);
  bool has_front = false;
  reader.take(has_front);
  if (has_front) reader.take(sample.front.emplace());
  std::uint64_t warnings = 0;
  reader.take(warnings);
  for (; warnings > 0 && reader.sound(); --warnings) visit_warning(sample.warnings.emplace_back(), take_field);
  return sample;
}

}  // namespace

std::string bytes_of(std::span<const Sample> samples) {
  std::string out;
  ByteWriter writer(out);
  writer.put(std::uint64_t{samples.size()});
  for (const Sample& sample : samples) put(writer, sample);
  return out;
}

std::optional<std::vector<Sample>> samples_of(std::string_view bytes) {
  ByteReader reader(bytes);
  std::uint64_t count = 0;
  reader.take(count);
  std::vector<Sample> out;
  for (; count > 0 && reader.sound(); --count) out.push_back(take(reader));
  if (!reader.sound() || !reader.at_end()) return std::nullopt;
  return out;
}

}  // namespace cellcrush
