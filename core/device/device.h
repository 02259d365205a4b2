#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "cellcrush/device.h"

namespace cellcrush {

/// Memory and threads of a device: all that differs between kinds of them. Throws DeviceError.
class Device {
 public:
  Device() = default;
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] virtual std::string name() const = 0;

  /// Memory that `free` takes back; its contents are arbitrary.
  virtual void* allocate(std::size_t bytes) = 0;
  virtual void free(void* memory) = 0;
  virtual void write(void* to, const void* from, std::size_t bytes) = 0;
  virtual void read(void* to, const void* from, std::size_t bytes) = 0;

  /// Advances a crush (device/crush-inl.h) in the memory of the device, of walls of a kind (device/steps-inl.h), by
  /// some steps, then sums what a sample needs. `crush` is a copy of it on the processor.
  virtual void advance(const void* crush, void* on_device, int walls, std::int64_t steps) = 0;
};

/// An engine on a device.
std::unique_ptr<DeviceEngine> make_engine(std::unique_ptr<Device> device);

/// A device that is emulated: threads are computed one after the other, in another order in every phase, and its memory
/// is filled with bits of no number.
std::unique_ptr<Device> make_emulated_device();

}  // namespace cellcrush
