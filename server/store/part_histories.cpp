#include "store/part_histories.h"

#include <google/protobuf/message.h>

#include <algorithm>
#include <utility>

#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

using google::protobuf::FieldDescriptor;

PartKind kind_of(const char* group, int field) { return {group, v1::Sample::descriptor()->FindFieldByNumber(field)}; }

// The numbers of a part; its first field is its id.
std::vector<const FieldDescriptor*> numbers_of(const PartKind& kind) {
  std::vector<const FieldDescriptor*> out;
  for (int i = 1; i < kind.field->message_type()->field_count(); ++i)
    out.push_back(kind.field->message_type()->field(i));
  return out;
}

const google::protobuf::Message& part_of(const PartKind& kind, const v1::Sample& sample, int part) {
  return v1::Sample::GetReflection()->GetRepeatedMessage(sample, kind.field, part);
}

int part_count(const PartKind& kind, const v1::Sample& sample) {
  return v1::Sample::GetReflection()->FieldSize(sample, kind.field);
}

Hdf5Handle make_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          "Creating the group " + name};
}

void read_part(hid_t file, const PartKind& kind, const std::string& id, hsize_t first, std::span<v1::Sample> samples) {
  std::vector<google::protobuf::Message*> parts;
  for (v1::Sample& sample : samples) {
    parts.push_back(v1::Sample::GetReflection()->AddMessage(&sample, kind.field));
    parts.back()->GetReflection()->SetString(parts.back(), kind.field->message_type()->field(0), id);
  }
  std::vector<double> rows(samples.size());
  for (const FieldDescriptor* number : numbers_of(kind)) {
    const std::string name(number->name());
    const auto data = open_result_dataset(file, kind.group + ("/" + id), name, H5T_IEEE_F64LE, 1);
    if (shape_of(data.id())[0] < first + rows.size()) throw damaged_result(name + " of " + id + " is too short");
    read_rows(data.id(), H5T_NATIVE_DOUBLE, first, rows.size(), rows.data());
    for (std::size_t i = 0; i < rows.size(); ++i) parts[i]->GetReflection()->SetDouble(parts[i], number, rows[i]);
  }
}

}  // namespace

PartKind watched_nodes() { return kind_of("nodes", v1::Sample::kWatchedFieldNumber); }
PartKind rigid_walls() { return kind_of("rigid_walls", v1::Sample::kRigidWallsFieldNumber); }

void PartHistories::append(hid_t file, std::span<const v1::Sample> samples) {
  if (samples.empty() || part_count(kind_, samples.front()) == 0) return;
  if (written_.empty()) make_parts(file, samples.front());
  const auto numbers = numbers_of(kind_);
  std::vector<double> rows(samples.size());
  for (std::size_t part = 0; part < written_.size(); ++part) {
    for (std::size_t column = 0; column < numbers.size(); ++column) {
      std::ranges::transform(samples, rows.begin(), [&](const v1::Sample& sample) {
        const auto& message = part_of(kind_, sample, static_cast<int>(part));
        return message.GetReflection()->GetDouble(message, numbers[column]);
      });
      append_rows(written_[part].columns[column].id(), H5T_NATIVE_DOUBLE, rows.size(), rows.data());
    }
  }
}

void PartHistories::make_parts(hid_t file, const v1::Sample& sample) {
  all_ = make_group(file, kind_.group);
  for (int i = 0; i < part_count(kind_, sample); ++i) {
    const auto& message = part_of(kind_, sample, i);
    Part part;
    part.group = make_group(all_.id(), message.GetReflection()->GetString(message, message.GetDescriptor()->field(0)));
    for (const FieldDescriptor* number : numbers_of(kind_)) {
      const std::string name(number->name());
      part.columns.push_back(
          make_growing_dataset(part.group.id(), name.c_str(), H5T_IEEE_F64LE, {}, {kHistoryChunkRows}));
    }
    written_.push_back(std::move(part));
  }
}

void PartHistories::close() {
  if (written_.empty()) return;
  const std::string what = "Closing the result";
  for (Part& part : written_) {
    for (Hdf5Handle& column : part.columns) column.close(what);
    part.group.close(what);
  }
  all_.close(what);
}

void read_parts(hid_t file, const v1::Case& scene, hsize_t first, std::span<v1::Sample> samples) {
  const v1::Frame& frame = scene.lattice().frame();
  for (const auto& node : frame.watched_nodes()) read_part(file, watched_nodes(), node, first, samples);
  for (const auto& wall : frame.rigid_walls()) read_part(file, rigid_walls(), wall.id(), first, samples);
  for (const auto& wall : scene.loading().rigid_walls()) read_part(file, rigid_walls(), wall.id(), first, samples);
}

}  // namespace cellcrush::store
