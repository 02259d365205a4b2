#include "store/result_reader.h"

#include "error.h"
#include "store/result_layout.h"

namespace cellcrush::store {

ResultReader::ResultReader(const std::filesystem::path& path) {
  silence_hdf5();
  file_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "Opening " + path.string());
}

Hdf5Handle ResultReader::dataset(const std::string& path) const {
  return {H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), H5Dclose, "Opening the dataset " + path};
}

std::vector<double> ResultReader::column(const std::string& path) const {
  const Hdf5Handle data = dataset(path);
  std::vector<double> out(shape_of(data.id())[0]);
  if (!out.empty()) read_rows(data.id(), H5T_NATIVE_DOUBLE, 0, out.size(), out.data());
  return out;
}

std::string ResultReader::text_attribute(const char* name) const { return read_text_attribute(file_.id(), name); }

std::vector<v1::Sample> ResultReader::history() const {
  std::vector<v1::Sample> out;
  for (const auto& layout : kHistoryColumns) {
    const auto values = column(std::string("/history/") + layout.name);
    if (out.empty()) out.resize(values.size());
    if (out.size() != values.size())
      throw ServiceError(ServiceError::Kind::internal, "The columns of the history differ in length.");
    for (std::size_t i = 0; i < values.size(); ++i) layout.set(out[i], values[i]);
  }
  return out;
}

std::vector<double> ResultReader::frame_times() const { return column("/frames/time_s"); }

std::vector<double> ResultReader::frame_strains() const { return column("/frames/strain"); }

v1::FieldFrame ResultReader::frame(int index) const {
  v1::FieldFrame out;
  const auto row = static_cast<hsize_t>(index);
  out.set_index(index);
  double value = 0.0;
  read_rows(dataset("/frames/time_s").id(), H5T_NATIVE_DOUBLE, row, 1, &value);
  out.set_time_s(value);
  read_rows(dataset("/frames/strain").id(), H5T_NATIVE_DOUBLE, row, 1, &value);
  out.set_strain(value);
  const Hdf5Handle positions = dataset("/frames/position_mm");
  out.mutable_position_mm()->Resize(static_cast<int>(2 * shape_of(positions.id())[1]), 0.0F);
  read_rows(positions.id(), H5T_NATIVE_FLOAT, row, 1, out.mutable_position_mm()->mutable_data());
  const Hdf5Handle plastic = dataset("/frames/plastic_fraction");
  out.mutable_plastic_fraction()->Resize(static_cast<int>(shape_of(plastic.id())[1]), 0.0F);
  read_rows(plastic.id(), H5T_NATIVE_FLOAT, row, 1, out.mutable_plastic_fraction()->mutable_data());
  return out;
}

}  // namespace cellcrush::store
