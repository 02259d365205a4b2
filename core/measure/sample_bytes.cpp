#include <cstdint>

#include "cellcrush/byte_stream.h"
#include "cellcrush/sample.h"

namespace cellcrush {
namespace {

template <class W, class Visitor>
void visit_warning(W& warning, const Visitor& visit) {
  visit(warning.kind, warning.step, warning.strain, warning.message, warning.remedy);
}

void put(ByteWriter& writer, const Sample& sample) {
  const auto put_all = [&writer](const auto&... fields) { (writer.put(fields), ...); };
  visit_columns(sample, [&writer](const char* /*name*/, const auto& number, double /*scale*/) { writer.put(number); });
  put_all(sample.crush_mode, sample.densest_layer, sample.watched, sample.rigid_walls, sample.grips, sample.breaks);
  writer.put(sample.front.has_value());
  if (sample.front) writer.put(*sample.front);
  writer.put(std::uint64_t{sample.warnings.size()});
  for (const Warning& warning : sample.warnings) visit_warning(warning, put_all);
}

Sample take(ByteReader& reader) {
  Sample sample;
  const auto take_all = [&reader](auto&... fields) { (reader.take(fields), ...); };
  visit_columns(sample, [&reader](const char* /*name*/, auto& number, double /*scale*/) { reader.take(number); });
  take_all(sample.crush_mode, sample.densest_layer, sample.watched, sample.rigid_walls, sample.grips, sample.breaks);
  bool has_front = false;
  reader.take(has_front);
  if (has_front) reader.take(sample.front.emplace());
  std::uint64_t warnings = 0;
  reader.take(warnings);
  for (; warnings > 0 && reader.sound(); --warnings) visit_warning(sample.warnings.emplace_back(), take_all);
  return sample;
}

}  // namespace

std::string bytes_of(std::span<const Sample> samples) {
  std::string out;
  ByteWriter writer(append_to(out));
  writer.put(std::uint64_t{samples.size()});
  for (const Sample& sample : samples) put(writer, sample);
  return out;
}

std::optional<std::vector<Sample>> samples_of(std::string_view bytes) {
  ByteReader reader(source_of(bytes));
  std::uint64_t count = 0;
  reader.take(count);
  std::vector<Sample> out;
  for (; count > 0 && reader.sound(); --count) out.push_back(take(reader));
  if (!reader.sound() || !reader.at_end()) return std::nullopt;
  return out;
}

}  // namespace cellcrush
