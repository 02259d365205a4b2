#include "store/hdf5.h"

#include <fmt/format.h>

#include <cerrno>
#include <new>
#include <string_view>
#include <system_error>

#include "error.h"

namespace cellcrush::store {
namespace {

// The innermost reason of an error stack, or a shortage if one is among the reasons.
struct Reason {
  std::string text;
  Shortage shortage = Shortage::none;
  bool is_memory = false;
};

herr_t note_reason(unsigned position, const H5E_error2_t* error, void* data) {
  auto& reason = *static_cast<Reason*>(data);
  if (error->desc == nullptr || reason.shortage != Shortage::none) return 0;
  if (position == 0) reason.text = error->desc;
  reason.is_memory |= std::string_view(error->desc).find("memory allocation failed") != std::string_view::npos;
  for (const int code : {ENOSPC, EDQUOT, EFBIG, EMFILE, ENFILE, EACCES, EROFS, EIO}) {
    const std::string text = std::generic_category().message(code);
    if (std::string_view(error->desc).find(text) != std::string_view::npos) reason = {text, shortage_of_errno(code)};
  }
  return 0;
}

[[noreturn]] void fail(const std::string& what) {
  Reason reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note_reason, &reason);
  if (reason.is_memory) throw std::bad_alloc();
  const std::string message = what + " failed: " + (reason.text.empty() ? "HDF5 gave no reason" : reason.text) + ".";
  if (reason.shortage != Shortage::none) throw ServiceError(reason.shortage, message);
  throw ServiceError(ServiceError::Kind::internal, message);
}

Hdf5Handle dataspace(const std::vector<hsize_t>& shape, const std::vector<hsize_t>& limit) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), limit.data()), H5Sclose,
          "Creating a data space"};
}

Hdf5Handle text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "Creating a text type");
  check_hdf5(H5Tset_size(type.id(), H5T_VARIABLE), "Creating a text type");
  check_hdf5(H5Tset_cset(type.id(), H5T_CSET_UTF8), "Creating a text type");
  return type;
}

void write_scalar(hid_t object, const char* name, hid_t stored, hid_t native, const void* value) {
  const std::string what = std::string("Writing the attribute ") + name;
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Hdf5Handle attribute(H5Acreate2(object, name, stored, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  check_hdf5(H5Awrite(attribute.id(), native, value), what);
}

// Selects rows in the file and makes the matching space in memory.
std::pair<Hdf5Handle, Hdf5Handle> select_rows(hid_t dataset, hsize_t first, hsize_t rows) {
  Hdf5Handle in_file(H5Dget_space(dataset), H5Sclose, "Reading a shape");
  std::vector<hsize_t> count = shape_of(dataset);
  count[0] = rows;
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = first;
  check_hdf5(H5Sselect_hyperslab(in_file.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
             "Selecting rows");
  return {std::move(in_file), dataspace(count, count)};
}

// An attribute with one value.
Hdf5Handle open_scalar(hid_t object, const char* name, const std::string& what) {
  Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, what);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose, what);
  if (H5Sget_simple_extent_npoints(space.id()) == 1) return attribute;
  throw ServiceError(ServiceError::Kind::data_loss, what + " failed: it is not a single value.");
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, CloseFunction close_function, const std::string& what)
    : id_(id), close_(close_function) {
  if (id_ < 0) fail(what);
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) close_(id_);
}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

void Hdf5Handle::close(const std::string& what) {
  if (id_ >= 0) check_hdf5(close_(std::exchange(id_, H5I_INVALID_HID)), what);
}

void check_hdf5(herr_t code, const std::string& what) {
  if (code < 0) fail(what);
}

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

void write_attribute(hid_t object, const char* name, const std::string& value) {
  const Hdf5Handle type = text_type();
  const char* text = value.c_str();
  write_scalar(object, name, type.id(), type.id(), &text);
}

void write_attribute(hid_t object, const char* name, double value) {
  write_scalar(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void write_attribute(hid_t object, const char* name, std::int64_t value) {
  write_scalar(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

std::string read_text_attribute(hid_t object, const char* name) {
  const std::string what = std::string("Reading the attribute ") + name;
  // HDF5 writes one pointer per text of the attribute.
  const Hdf5Handle attribute = open_scalar(object, name, what);
  const Hdf5Handle type = text_type();
  char* text = nullptr;
  check_hdf5(H5Aread(attribute.id(), type.id(), static_cast<void*>(&text)), what);
  std::string out = text == nullptr ? "" : text;
  H5free_memory(text);
  return out;
}

double read_number_attribute(hid_t object, const char* name) {
  const std::string what = std::string("Reading the attribute ") + name;
  const Hdf5Handle attribute = open_scalar(object, name, what);
  double out = 0.0;
  check_hdf5(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &out), what);
  return out;
}

Hdf5Handle make_growing_dataset(hid_t folder, const std::string& path, hid_t type,
                                const std::vector<hsize_t>& row_shape, const std::vector<hsize_t>& chunk) {
  const std::string what = "Creating the dataset " + path;
  std::vector<hsize_t> shape{0};
  std::vector<hsize_t> limit{H5S_UNLIMITED};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  limit.insert(limit.end(), row_shape.begin(), row_shape.end());
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  check_hdf5(H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data()), what);
  check_hdf5(H5Pset_shuffle(properties.id()), what);
  check_hdf5(H5Pset_deflate(properties.id(), 4), what);
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  check_hdf5(H5Pset_create_intermediate_group(links.id(), 1), what);
  const Hdf5Handle space = dataspace(shape, limit);
  return {H5Dcreate2(folder, path.c_str(), type, space.id(), links.id(), properties.id(), H5P_DEFAULT), H5Dclose, what};
}

void append_rows(hid_t dataset, hid_t type, hsize_t rows, const void* data) {
  std::vector<hsize_t> shape = shape_of(dataset);
  const hsize_t first = shape[0];
  shape[0] += rows;
  check_hdf5(H5Dset_extent(dataset, shape.data()), "Extending a dataset");
  const auto [in_file, in_memory] = select_rows(dataset, first, rows);
  check_hdf5(H5Dwrite(dataset, type, in_memory.id(), in_file.id(), H5P_DEFAULT, data), "Writing rows");
}

Hdf5Handle write_dataset(hid_t folder, const char* name, hid_t type, const std::vector<hsize_t>& shape,
                         const void* data) {
  const std::string what = std::string("Writing the dataset ") + name;
  const Hdf5Handle space = dataspace(shape, shape);
  Hdf5Handle dataset(H5Dcreate2(folder, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, what);
  check_hdf5(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), what);
  return dataset;
}

void describe(hid_t dataset, const std::string& unit, const std::string& description) {
  write_attribute(dataset, "units", unit.empty() ? "1" : unit);
  write_attribute(dataset, "description", description);
}

void make_scale(hid_t dataset, const std::string& name) {
  check_hdf5(H5DSset_scale(dataset, name.c_str()), "Making the scale " + name);
}

Hdf5Handle make_dimension(hid_t folder, const std::string& name, hsize_t extent, const std::string& description) {
  const std::string what = "Making the dimension " + name;
  const Hdf5Handle space = dataspace({extent}, {extent});
  Hdf5Handle out(H5Dcreate2(folder, name.c_str(), H5T_IEEE_F32LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                 H5Dclose, what);
  // The name by which netCDF's programs know that there are no numbers.
  describe(out.id(), "", description);
  make_scale(out.id(), fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", extent));
  return out;
}

void attach_scales(hid_t dataset, const std::vector<hid_t>& scales) {
  for (unsigned i = 0; i < scales.size(); ++i) check_hdf5(H5DSattach_scale(dataset, scales[i], i), "Attaching a scale");
}

bool has_link(hid_t folder, const std::string& path) { return H5Lexists(folder, path.c_str(), H5P_DEFAULT) > 0; }

void make_link(hid_t folder, const std::string& dataset, const std::string& path) {
  check_hdf5(H5Lcreate_hard(folder, dataset.c_str(), folder, path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
             "Linking " + path);
}

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, "Reading a shape");
  const int rank = H5Sget_simple_extent_ndims(space.id());
  check_hdf5(rank, "Reading a shape");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  check_hdf5(H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr), "Reading a shape");
  return shape;
}

void read_rows(hid_t dataset, hid_t type, hsize_t first, hsize_t rows, void* data) {
  const auto [in_file, in_memory] = select_rows(dataset, first, rows);
  check_hdf5(H5Dread(dataset, type, in_memory.id(), in_file.id(), H5P_DEFAULT, data), "Reading rows");
}

}  // namespace cellcrush::store
