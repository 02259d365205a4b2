#include "e2e/result_file.h"

#include <hdf5.h>

#include <stdexcept>

namespace cellcrush::e2e {
namespace {

// Closes an HDF5 object at the end of a scope; throws when opening it has failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error(what + " is not there or cannot be read");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle open_dataset(hid_t file, const std::string& name) {
  return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

std::vector<std::int64_t> extent(hid_t dataset, const std::string& name) {
  const Handle space(H5Dget_space(dataset), H5Sclose, name);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.id())));
  H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

}  // namespace

ResultFile::ResultFile(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw std::runtime_error(path.string() + " is not a complete HDF5 file");
}

ResultFile::~ResultFile() { H5Fclose(file_); }

std::vector<std::int64_t> ResultFile::shape(const std::string& name) const {
  return extent(open_dataset(file_, name).id(), name);
}

std::vector<double> ResultFile::values(const std::string& name) const {
  const Handle dataset = open_dataset(file_, name);
  std::size_t count = 1;
  for (const std::int64_t size : extent(dataset.id(), name)) count *= static_cast<std::size_t>(size);
  std::vector<double> numbers(count);
  if (H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
    throw std::runtime_error(name + " cannot be read");
  return numbers;
}

bool ResultFile::is_extendible_and_compressed(const std::string& name) const {
  const Handle dataset = open_dataset(file_, name);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, name);
  const Handle properties(H5Dget_create_plist(dataset.id()), H5Pclose, name);
  std::vector<hsize_t> largest(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.id())));
  H5Sget_simple_extent_dims(space.id(), nullptr, largest.data());
  return !largest.empty() && largest[0] == H5S_UNLIMITED && H5Pget_nfilters(properties.id()) > 0;
}

int ResultFile::number_size(const std::string& name) const {
  const Handle dataset = open_dataset(file_, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, name);
  return static_cast<int>(H5Tget_size(type.id()));
}

std::vector<std::string> ResultFile::attributes() const {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  H5Aiterate2(file_, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

}  // namespace cellcrush::e2e
