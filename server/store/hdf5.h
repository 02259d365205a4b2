#pragma once

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cellcrush::store {

/// An HDF5 identifier that closes itself.
class Hdf5Handle {
 public:
  using CloseFunction = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  /// Throws ServiceError with HDF5's own reason if `id` is negative. `what`: the operation, for the message.
  Hdf5Handle(hid_t id, CloseFunction close_function, const std::string& what);
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;

  [[nodiscard]] hid_t id() const { return id_; }
  /// Closes now. Throws ServiceError if that fails, since buffered data may be lost.
  void close(const std::string& what);

 private:
  hid_t id_ = H5I_INVALID_HID;
  CloseFunction close_ = nullptr;
};

/// Throws ServiceError with HDF5's own reason if `code` is negative: with its shortage, otherwise internal.
void check_hdf5(herr_t code, const std::string& what);

/// Keeps HDF5 from printing its errors in this thread; they become exceptions instead.
void silence_hdf5();

void write_attribute(hid_t object, const char* name, const std::string& value);
void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, std::int64_t value);

std::string read_text_attribute(hid_t object, const char* name);
double read_number_attribute(hid_t object, const char* name);

/// A dataset that grows along its first dimension; chunked, shuffled, deflated. Missing groups of its path are made.
/// `row_shape`: extents of the other dimensions; `chunk`: extents of a chunk in all dimensions.
Hdf5Handle make_growing_dataset(hid_t folder, const std::string& path, hid_t type,
                                const std::vector<hsize_t>& row_shape, const std::vector<hsize_t>& chunk);

/// Appends `rows` rows of native type `type`.
void append_rows(hid_t dataset, hid_t type, hsize_t rows, const void* data);

/// Writes a dataset of fixed shape at once.
Hdf5Handle write_dataset(hid_t folder, const char* name, hid_t type, const std::vector<hsize_t>& shape,
                         const void* data);

/// What the numbers of a dataset are. `unit`: empty for a number without one, which then has the unit "1".
void describe(hid_t dataset, const std::string& unit, const std::string& description);

/// Makes a dataset the scale of a dimension of this name.
void make_scale(hid_t dataset, const std::string& name);

/// A dimension scale without values of its own, as netCDF has it: a scale that takes no room.
Hdf5Handle make_dimension(hid_t folder, const std::string& name, hsize_t extent, const std::string& description);

/// Scales of the first dimensions of a dataset, in their order.
void attach_scales(hid_t dataset, const std::vector<hid_t>& scales);

/// Whether there is something at a path in an existing group.
bool has_link(hid_t folder, const std::string& path);

/// A second path to a dataset.
void make_link(hid_t folder, const std::string& dataset, const std::string& path);

/// Extents of a dataset.
std::vector<hsize_t> shape_of(hid_t dataset);

/// Reads `rows` rows starting at `first` as native type `type`.
void read_rows(hid_t dataset, hid_t type, hsize_t first, hsize_t rows, void* data);

}  // namespace cellcrush::store
