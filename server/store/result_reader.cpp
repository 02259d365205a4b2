#include "store/result_reader.h"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "cellcrush/v1/case.pb.h"
#include "columns/sample_parts.h"
#include "store/durable_file.h"
#include "store/result_job.h"
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

template <typename Number>
void read_all(const Hdf5Handle& dataset, hid_t type, google::protobuf::RepeatedField<Number>& out) {
  const auto shape = shape_of(dataset.id());
  const hsize_t count = std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
  if (count > std::numeric_limits<int>::max()) throw damaged_result("its mesh is too large");
  out.Resize(static_cast<int>(count), Number{});
  if (count > 0) read_rows(dataset.id(), type, 0, shape[0], out.mutable_data());
}

}  // namespace

ResultReader::ResultReader(const std::filesystem::path& path) : identity_(check_seal(path)) {
  silence_hdf5();
  const OpenFile file = open_to_read(path, ServiceError::Kind::data_loss, LastLink::of_owner);
  file_ = Hdf5Handle(H5Fopen(path_of(file).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "Opening " + path.string());
}

std::vector<double> ResultReader::column(const std::string& path, hid_t type, hsize_t first, hsize_t count) const {
  const Hdf5Handle data = open_result_dataset(file_.id(), path, type, 1);
  const hsize_t rows = shape_of(data.id())[0];
  std::vector<double> out(first < rows ? std::min(count, rows - first) : 0);
  if (!out.empty()) read_rows(data.id(), H5T_NATIVE_DOUBLE, first, out.size(), out.data());
  return out;
}

bool ResultReader::has(const std::string& path) const { return has_link(file_.id(), path); }

v1::Job ResultReader::job() const { return read_job_of_result(file_.id()); }

v1::Mesh ResultReader::mesh() const {
  v1::Mesh out;
  read_all(open_result_dataset(file_.id(), "mesh/beam_nodes", H5T_STD_I32LE, 2), H5T_NATIVE_INT32,
           *out.mutable_element_nodes());
  read_all(open_result_dataset(file_.id(), "mesh/thickness_mm", H5T_IEEE_F32LE, 1), H5T_NATIVE_FLOAT,
           *out.mutable_thickness_mm());
  read_all(open_result_dataset(file_.id(), "mesh/position_mm", H5T_IEEE_F32LE, 2), H5T_NATIVE_FLOAT,
           *out.mutable_position_mm());
  if (has("mesh/element_wall")) {  // a file of an earlier version lacks it
    read_all(open_result_dataset(file_.id(), "mesh/element_wall", H5T_STD_I32LE, 1), H5T_NATIVE_INT32,
             *out.mutable_element_wall());
  }
  if (has("mesh/overlap_particle")) {
    read_all(open_result_dataset(file_.id(), "mesh/overlap_particle", H5T_STD_I32LE, 1), H5T_NATIVE_INT32,
             *out.mutable_overlap_particle());
  }
  if (has("mesh/gripped")) {
    read_all(open_result_dataset(file_.id(), "mesh/gripped", H5T_STD_I32LE, 1), H5T_NATIVE_INT32,
             *out.mutable_gripped());
  }
  out.set_particle_count(out.position_mm_size() / 2);
  const auto is_particle = [&out](int node) { return node >= 0 && node < out.particle_count(); };
  if (out.element_nodes_size() != 2 * out.thickness_mm_size() ||
      !std::ranges::all_of(out.element_nodes(), is_particle) ||
      !std::ranges::all_of(out.overlap_particle(), is_particle) || !std::ranges::all_of(out.gripped(), is_particle))
    throw damaged_result("its mesh contradicts itself");
  const Hdf5Handle group(H5Gopen2(file_.id(), "mesh", H5P_DEFAULT), H5Gclose, "Opening the group mesh");
  const auto number = [&group](const char* name) { return read_number_attribute(group.id(), name); };
  if (H5Aexists(group.id(), "rigid_element_count") > 0)
    out.set_rigid_element_count(static_cast<std::int32_t>(number("rigid_element_count")));
  out.set_length_mm(number("length_mm"));
  out.set_width_mm(number("width_mm"));
  out.set_impact_plate_mm(number("impact_plate_mm"));
  out.set_support_plate_mm(number("support_plate_mm"));
  out.set_along_y(number("along_y") != 0.0);
  for (const auto& [name, set] :
       {std::pair("side_low_mm", &v1::Mesh::set_side_low_mm), std::pair("side_high_mm", &v1::Mesh::set_side_high_mm)}) {
    if (H5Aexists(group.id(), name) > 0) (out.*set)(number(name));  // a file of an earlier version lacks it
  }
  return out;
}

std::string ResultReader::text_attribute(const char* name) const { return read_text_attribute(file_.id(), name); }

// In the order of the case, as the groups of the file have none.
v1::Sample ResultReader::sample_without_numbers() const {
  if (!has("nodes") && !has("rigid_walls") && !has("grips")) return {};
  v1::Case submitted;
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;
  if (!google::protobuf::util::JsonStringToMessage(text_attribute("case"), &submitted, options).ok())
    throw damaged_result("its case cannot be read");
  return sample_parts_of(submitted);
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
  add_breaks(first, out);
  return out;
}

std::vector<v1::Break> ResultReader::breaks() const {
  std::vector<v1::Break> out;
  if (!has("breaks")) return out;  // nothing broke, or a file of an earlier version
  for (const BreakColumn& layout : break_columns()) {
    const auto values = column(layout.path, layout.type());
    if (out.empty()) out.resize(values.size());
    if (out.size() != values.size()) throw damaged_result("the columns of its breaks differ in length");
    for (std::size_t k = 0; k < out.size(); ++k) layout.set(out[k], values[k]);
  }
  return out;
}

// Each break belongs to the sample by which the count of breaks includes it.
void ResultReader::add_breaks(std::int64_t first, std::vector<v1::Sample>& samples) const {
  const std::vector<v1::Break> all = breaks();
  if (all.empty() || samples.empty()) return;
  const auto before = first == 0 ? std::vector<double>()
                                 : column("history/break_count", H5T_STD_I64LE, static_cast<hsize_t>(first - 1), 1);
  auto begin = static_cast<std::int64_t>(before.empty() ? 0.0 : before.front());
  for (v1::Sample& sample : samples) {
    const std::int64_t end = sample.break_count();
    if (begin < 0 || end < begin || end > static_cast<std::int64_t>(all.size()))
      throw damaged_result("its breaks do not match its history");
    sample.mutable_breaks()->Add(all.begin() + begin, all.begin() + end);
    begin = end;
  }
}

void ResultReader::add_broken_ends(std::size_t row, v1::FieldFrame& frame) const {
  if (!has(kFrameBreaks)) return;
  const std::vector<v1::Break> all = breaks();
  const std::vector<double> counts = column(kFrameBreaks, H5T_STD_I64LE);
  const Hdf5Handle ends = open_result_dataset(file_.id(), kFrameEnds, H5T_IEEE_F32LE, 2);
  const auto shape = shape_of(ends.id());
  double first = 0.0;
  for (std::size_t i = 0; i < std::min(row, counts.size()); ++i) first += counts[i];
  const double count = row < counts.size() ? counts[row] : -1.0;
  if (count < 0.0 || count > static_cast<double>(all.size()) || shape[1] != 2 || first < 0.0 ||
      first + count > static_cast<double>(shape[0]))
    throw damaged_result("the broken ends of its frames do not match");
  if (count == 0.0) return;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    if (all[k].element() < 0 || all[k].element() >= frame.plastic_fraction_size())
      throw damaged_result("a broken end is of no element");
    frame.add_broken_end(2 * all[k].element() + (all[k].at_end() ? 1 : 0));
  }
  frame.mutable_end_position_mm()->Resize(2 * static_cast<int>(count), 0.0F);
  read_rows(ends.id(), H5T_NATIVE_FLOAT, static_cast<hsize_t>(first), static_cast<hsize_t>(count),
            frame.mutable_end_position_mm()->mutable_data());
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
  if (has("frames/fibre_strain")) {
    read_row(open_result_dataset(file_.id(), "frames/fibre_strain", H5T_IEEE_F32LE, 2), row,
             *out.mutable_fibre_strain());
  }
  if (has("frames/local_strain")) {
    read_row(open_result_dataset(file_.id(), "frames/local_strain", H5T_IEEE_F32LE, 2), row,
             *out.mutable_local_strain());
  }
  add_broken_ends(row, out);
  return out;
}

}  // namespace cellcrush::store
