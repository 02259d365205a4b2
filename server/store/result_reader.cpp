#include "store/result_reader.h"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <limits>

#include "cellcrush/v1/case.pb.h"
#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

// The numbers of one row.
void read_row(const Hdf5Handle& dataset, hsize_t row, google::protobuf::RepeatedField<float>& out) {
  const auto shape = shape_of(dataset.id());
  hsize_t count = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) count *= shape[i];
  if (row >= shape[0] || count > std::numeric_limits<int>::max()) throw damaged_result("the frame is missing");
  out.Resize(static_cast<int>(count), 0.0F);
  if (count > 0) read_rows(dataset.id(), H5T_NATIVE_FLOAT, row, 1, out.mutable_data());
}

}  // namespace

ResultReader::ResultReader(const std::filesystem::path& path) : identity_(check_seal(path)) {
  silence_hdf5();
  file_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "Opening " + path.string());
}

std::vector<double> ResultReader::column(const std::string& path, hid_t type, hsize_t first, hsize_t count) const {
  const Hdf5Handle data = open_result_dataset(file_.id(), path, type, 1);
  const hsize_t rows = shape_of(data.id())[0];
  std::vector<double> out(first < rows ? std::min(count, rows - first) : 0);
  if (!out.empty()) read_rows(data.id(), H5T_NATIVE_DOUBLE, first, out.size(), out.data());
  return out;
}

bool ResultReader::has(const std::string& path) const { return has_link(file_.id(), path); }

std::string ResultReader::text_attribute(const char* name) const { return read_text_attribute(file_.id(), name); }

// In the order of the case, as the groups of the file have none.
v1::Sample ResultReader::sample_without_numbers() const {
  v1::Sample out;
  if (!has("nodes") && !has("rigid_walls")) return out;
  v1::Case submitted;
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;
  if (!google::protobuf::util::JsonStringToMessage(text_attribute("case"), &submitted, options).ok())
    throw damaged_result("its case cannot be read");
  const v1::Frame& frame = submitted.lattice().frame();
  for (const auto& node : frame.watched_nodes()) out.add_watched()->set_node(node);
  for (const auto* walls : {&frame.rigid_walls(), &submitted.loading().rigid_walls()}) {
    for (const auto& wall : *walls) out.add_rigid_walls()->set_wall(wall.id());
  }
  return out;
}

std::vector<v1::Sample> ResultReader::history(std::int64_t first, std::int64_t count) const {
  constexpr const char* kOldest = "history/time_s";
  const auto from = static_cast<hsize_t>(first);
  const v1::Sample blank = sample_without_numbers();
  std::vector<v1::Sample> out;
  for (const auto& layout : history_columns(blank)) {
    // A file of an earlier version lacks some of /history.
    if (layout.path.starts_with("history/") && layout.path != kOldest && !has(layout.path)) continue;
    const auto values = column(layout.path, layout.type(), from, static_cast<hsize_t>(count));
    if (layout.path == kOldest) out.resize(values.size(), blank);
    if (out.size() != values.size()) throw damaged_result("the columns of its history differ in length");
    layout.set(out, values);
  }
  return out;
}

std::vector<double> ResultReader::frame_times() const { return column("frames/time_s", H5T_IEEE_F64LE); }

std::vector<double> ResultReader::frame_strains() const { return column("frames/strain", H5T_IEEE_F64LE); }

v1::FieldFrame ResultReader::frame(int index) const {
  const auto times = frame_times();
  const auto strains = frame_strains();
  const auto row = static_cast<std::size_t>(index);
  if (index < 0 || row >= times.size() || row >= strains.size()) throw damaged_result("the frame is missing");
  v1::FieldFrame out;
  out.set_index(index);
  out.set_time_s(times[row]);
  out.set_strain(strains[row]);
  read_row(open_result_dataset(file_.id(), "frames/position_mm", H5T_IEEE_F32LE, 3), row, *out.mutable_position_mm());
  read_row(open_result_dataset(file_.id(), "frames/plastic_fraction", H5T_IEEE_F32LE, 2), row,
           *out.mutable_plastic_fraction());
  return out;
}

}  // namespace cellcrush::store
