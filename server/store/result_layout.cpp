#include "store/result_layout.h"

#include <fmt/format.h>
#include <google/protobuf/message.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>

#include "store/hdf5.h"

namespace cellcrush::store {
namespace {

constexpr double kGreatestDeflation = 1032.0;           // bytes that one deflated byte can represent
constexpr double kMostChunkBytes = 16.0 * 1024 * 1024;  // the writer's have half a MiB

double product(const std::vector<hsize_t>& extents) {
  return std::accumulate(extents.begin(), extents.end(), 1.0,
                         [](double so_far, hsize_t extent) { return so_far * static_cast<double>(extent); });
}

// A soft link could form a cycle; an external one could name any file.
bool is_hard_link(hid_t group, const std::string& name) {
  H5L_info_t info{};
  return H5Lget_info(group, name.c_str(), &info, H5P_DEFAULT) >= 0 && info.type == H5L_TYPE_HARD;
}

// Whether the filters are the writer's; HDF5 would load others from plugins.
bool has_known_filters(hid_t properties) {
  const int count = H5Pget_nfilters(properties);
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    unsigned settings = 0;
    const auto filter =
        H5Pget_filter2(properties, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, &settings);
    if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE) return false;
  }
  return count >= 0 && count <= 2;
}

// Chunks and the contiguous data of a mesh lie in this file; virtual datasets and external storage lie in others.
bool has_known_storage(hid_t properties, int rank, double item_bytes) {
  if (H5Pget_layout(properties) == H5D_CONTIGUOUS) return H5Pget_external_count(properties) == 0;
  std::vector<hsize_t> chunk(static_cast<std::size_t>(rank));
  return H5Pget_layout(properties) == H5D_CHUNKED && H5Pget_external_count(properties) == 0 &&
         has_known_filters(properties) && H5Pget_chunk(properties, rank, chunk.data()) == rank &&
         product(chunk) * item_bytes <= kMostChunkBytes;
}

bool is_of_type(hid_t dataset, hid_t type) {
  const Hdf5Handle stored(H5Dget_type(dataset), H5Tclose, "Reading a type");
  return H5Tequal(stored.id(), type) > 0;
}

bool has_room_for(hid_t file, hid_t dataset, double bytes) {
  hsize_t file_bytes = 0;
  check_hdf5(H5Fget_filesize(file, &file_bytes), "Reading a size");
  const hsize_t stored = H5Dget_storage_size(dataset);
  return stored <= file_bytes && bytes <= kGreatestDeflation * static_cast<double>(stored);
}

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// A column for each number of this type of the message.
void add_columns(const std::string& prefix, const google::protobuf::Descriptor& message, FieldDescriptor::CppType type,
                 const FieldDescriptor* owner, int part, std::vector<HistoryColumn>& out) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor* field = message.field(i);
    if (field->is_repeated() || field->cpp_type() != type) continue;
    out.push_back({prefix + std::string(field->name()), field, owner, part});
  }
}

// In the group of each part; the first field of its message is its id.
void add_part_columns(const std::string& group, int owner_number, const v1::Sample& sample,
                      std::vector<HistoryColumn>& out) {
  const FieldDescriptor* owner = v1::Sample::descriptor()->FindFieldByNumber(owner_number);
  const auto& reflection = *v1::Sample::GetReflection();
  for (int part = 0; part < reflection.FieldSize(sample, owner); ++part) {
    const Message& message = reflection.GetRepeatedMessage(sample, owner, part);
    const std::string id = message.GetReflection()->GetString(message, message.GetDescriptor()->field(0));
    add_columns(fmt::format("{}/{}/", group, id), *owner->message_type(), FieldDescriptor::CPPTYPE_DOUBLE, owner, part,
                out);
  }
}

// "V" of CRUSH_MODE_V.
std::string mode_name(v1::Summary::CrushMode mode) {
  constexpr std::size_t kPrefix = std::string_view("CRUSH_MODE_").size();
  return v1::Summary::CrushMode_Name(mode).substr(kPrefix);
}

std::string rise_name(v1::Summary::OtherRise rise) {
  constexpr std::size_t kPrefix = std::string_view("OTHER_RISE_").size();
  return v1::Summary::OtherRise_Name(rise).substr(kPrefix);
}

// An attribute for each double of the message that is present.
void write_numbers(hid_t file, const std::string& prefix, const google::protobuf::Message& message) {
  const auto& descriptor = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const auto& field = *descriptor.field(i);
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) continue;
    if (field.has_presence() && !reflection.HasField(message, &field)) continue;
    write_attribute(file, (prefix + std::string(field.name())).c_str(), reflection.GetDouble(message, &field));
  }
}

void write_collapse(hid_t file, const v1::Summary& summary) {
  write_attribute(file, "crush_mode", mode_name(summary.crush_mode()));
  if (summary.other_rise() != v1::Summary::OTHER_RISE_UNSPECIFIED)
    write_attribute(file, "other_rise", rise_name(summary.other_rise()));
  if (summary.has_shock_error_relative())
    write_attribute(file, "theory_shock_error_relative", summary.shock_error_relative());
  if (summary.has_front()) write_numbers(file, "front_", summary.front());
  if (summary.has_fibre_strain()) {
    write_numbers(file, "fibre_strain_", summary.fibre_strain());
    write_attribute(file, "fibre_strain_wall", static_cast<std::int64_t>(summary.fibre_strain().wall()));
  }
  if (summary.has_crush_forces()) write_numbers(file, "crush_forces_", summary.crush_forces());
  if (summary.has_quasi_static()) write_numbers(file, "quasi_static_", summary.quasi_static());
  for (const v1::RigidWallSummary& wall : summary.rigid_walls())
    write_numbers(file, "rigid_wall_" + wall.wall() + "_", wall);
}

void write_warnings(hid_t file, const v1::Summary& summary) {
  std::string lines;
  for (const v1::Warning& warning : summary.warnings())
    lines += (lines.empty() ? "" : "\n") + v1::Warning::Kind_Name(warning.kind()) + ": " + warning.message();
  if (!lines.empty()) write_attribute(file, "warnings", lines);
}

}  // namespace

ServiceError damaged_result(const std::string& what) {
  return {ServiceError::Kind::data_loss,
          "The result is damaged: " + what + ". Submit its case again; its summary is still available."};
}

Hdf5Handle open_result_dataset(hid_t file, const std::string& path, hid_t type, int rank) {
  for (auto end = path.find('/');; end = path.find('/', end + 1)) {
    if (!is_hard_link(file, path.substr(0, end))) throw damaged_result(path + " is missing");
    if (end == std::string::npos) break;
  }
  Hdf5Handle out(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "Opening the dataset " + path);
  const Hdf5Handle properties(H5Dget_create_plist(out.id()), H5Pclose, "Reading " + path);
  const auto item_bytes = static_cast<double>(H5Tget_size(type));
  // In this order: querying the shape of a virtual dataset opens its source files.
  if (!has_known_storage(properties.id(), rank, item_bytes) || !is_of_type(out.id(), type))
    throw damaged_result(path + " has a different storage layout from the one written");
  const auto shape = shape_of(out.id());
  if (shape.size() != static_cast<std::size_t>(rank) || !has_room_for(file, out.id(), product(shape) * item_bytes))
    throw damaged_result(path + " has a different shape from the one written");
  return out;
}

hid_t HistoryColumn::type() const {
  return field->cpp_type() == FieldDescriptor::CPPTYPE_INT64 ? H5T_STD_I64LE : H5T_IEEE_F64LE;
}

double HistoryColumn::get(const v1::Sample& sample) const {
  const auto& reflection = *v1::Sample::GetReflection();
  const Message* message = &sample;
  if (owner != nullptr && owner->is_repeated())
    message = &reflection.GetRepeatedMessage(sample, owner, part);
  else if (owner != nullptr && !reflection.HasField(sample, owner))
    return std::numeric_limits<double>::quiet_NaN();
  else if (owner != nullptr)
    message = &reflection.GetMessage(sample, owner);
  const auto& numbers = *message->GetReflection();
  return field->cpp_type() == FieldDescriptor::CPPTYPE_INT64 ? static_cast<double>(numbers.GetInt64(*message, field))
                                                             : numbers.GetDouble(*message, field);
}

// Reflections are asked for once: that takes longer than setting a number.
void HistoryColumn::set(std::span<v1::Sample> samples, std::span<const double> values) const {
  const bool is_count = field->cpp_type() == FieldDescriptor::CPPTYPE_INT64;
  const auto& reflection = *v1::Sample::GetReflection();
  const auto& numbers =
      *google::protobuf::MessageFactory::generated_factory()->GetPrototype(field->containing_type())->GetReflection();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::isnan(values[i])) continue;
    Message* message = &samples[i];
    if (owner != nullptr)
      message = owner->is_repeated() ? reflection.MutableRepeatedMessage(message, owner, part)
                                     : reflection.MutableMessage(message, owner);
    if (is_count)
      numbers.SetInt64(message, field, static_cast<std::int64_t>(values[i]));
    else
      numbers.SetDouble(message, field, values[i]);
  }
}

std::vector<HistoryColumn> history_columns(const v1::Sample& sample) {
  const auto& own = *v1::Sample::descriptor();
  const FieldDescriptor* front = own.FindFieldByNumber(v1::Sample::kFrontFieldNumber);
  std::vector<HistoryColumn> out;
  add_columns("history/", own, FieldDescriptor::CPPTYPE_DOUBLE, nullptr, 0, out);
  add_columns("history/front_", *front->message_type(), FieldDescriptor::CPPTYPE_DOUBLE, front, 0, out);
  add_columns("history/", own, FieldDescriptor::CPPTYPE_INT64, nullptr, 0, out);
  add_part_columns("nodes", v1::Sample::kWatchedFieldNumber, sample, out);
  add_part_columns("rigid_walls", v1::Sample::kRigidWallsFieldNumber, sample, out);
  add_part_columns("grips", v1::Sample::kGripsFieldNumber, sample, out);
  return out;
}

hid_t BreakColumn::type() const {
  return field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

double BreakColumn::get(const v1::Break& broken) const {
  const auto& numbers = *v1::Break::GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL: return numbers.GetBool(broken, field) ? 1.0 : 0.0;
    case FieldDescriptor::CPPTYPE_INT32: return numbers.GetInt32(broken, field);
    case FieldDescriptor::CPPTYPE_INT64: return static_cast<double>(numbers.GetInt64(broken, field));
    default: return numbers.GetDouble(broken, field);
  }
}

void BreakColumn::set(v1::Break& broken, double value) const {
  const auto& numbers = *v1::Break::GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL: numbers.SetBool(&broken, field, value != 0.0); break;
    case FieldDescriptor::CPPTYPE_INT32: numbers.SetInt32(&broken, field, static_cast<std::int32_t>(value)); break;
    case FieldDescriptor::CPPTYPE_INT64: numbers.SetInt64(&broken, field, static_cast<std::int64_t>(value)); break;
    default: numbers.SetDouble(&broken, field, value);
  }
}

std::vector<BreakColumn> break_columns() {
  std::vector<BreakColumn> out;
  const auto& message = *v1::Break::descriptor();
  for (int i = 0; i < message.field_count(); ++i) {
    out.push_back({"breaks/" + std::string(message.field(i)->name()), message.field(i)});
  }
  return out;
}

void write_summary_attributes(hid_t file, const v1::Summary& summary) {
  // The error of a theory is written with those of the theory.
  v1::Summary own = summary;
  own.clear_shock_error_relative();
  write_numbers(file, "", own);
  if (summary.has_plateau_stress_impact_mpa())
    write_attribute(file, "plateau_stress_mpa", summary.plateau_stress_impact_mpa());
  write_attribute(file, "step_count", static_cast<std::int64_t>(summary.step_count()));
  write_attribute(file, "rigid_link_count", static_cast<std::int64_t>(summary.rigid_link_count()));
  write_attribute(file, "start_overlap_count", static_cast<std::int64_t>(summary.start_overlap_count()));
  write_attribute(file, "break_count", static_cast<std::int64_t>(summary.break_count()));
  write_numbers(file, "theory_", summary.theory());
  write_warnings(file, summary);
  write_collapse(file, summary);
  write_numbers(file, "ledger_", summary.ledger());
  write_numbers(file, "stage_", summary.stage_times());
}

}  // namespace cellcrush::store
