#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "cellcrush/device.h"
#include "cellcrush/scene.h"
#include "device/crush-inl.h"

namespace cellcrush {

/// Arrays in the memory of a device.
class DeviceMemory {
  template <class T>
  using Array = HWY_NAMESPACE::Array<T>;

 public:
  explicit DeviceMemory(Device& device) : device_(device) {}
  ~DeviceMemory() {
    for (void* of : blocks_) device_.free(of);
  }
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  /// An array on the device with copies of some values.
  template <class T, class Values>
  Array<T> put(const Values& values) {
    using Value = std::remove_const_t<T>;
    static_assert(std::is_same_v<Value, std::remove_cvref_t<decltype(values[0])>>);
    const std::size_t bytes = values.size() * sizeof(Value);
    Array<T> array = room<T>(values.size());
    if (bytes > 0) device_.write(const_cast<Value*>(array.data()), values.data(), bytes);
    return array;
  }

  /// An array of any values.
  template <class T>
  Array<T> room(std::size_t count) {
    if (count == 0) return {};
    void* const of = device_.allocate(count * sizeof(T));
    blocks_.push_back(of);
    return {static_cast<T*>(of), count};
  }

  template <class T>
  Array<T> zeros(std::size_t count) {
    return put<T>(std::vector<T>(count, T{}));
  }

  /// Overwrites the first values of an array.
  template <class T>
  void write(const Array<T>& array, const std::vector<std::remove_const_t<T>>& values) {
    device_.write(const_cast<std::remove_const_t<T>*>(array.data()), values.data(), values.size() * sizeof(T));
  }

  /// Overwrites a vector by the values of an array.
  template <class T, class Values>
  void read(const Array<T>& array, Values& values) const {
    values.resize(array.size());
    if (!values.empty()) device_.read(values.data(), array.data(), values.size() * sizeof(T));
  }

 private:
  Device& device_;
  std::vector<void*> blocks_;
};

/// Copies to a device what a crush reads of a scene and never changes. Returns the kind of its walls
/// (device/steps-inl.h). In device/copy_scene.cpp.
int copy_scene(const Scene& scene, DeviceMemory& memory, HWY_NAMESPACE::Crush& crush);

}  // namespace cellcrush
