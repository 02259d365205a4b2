#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace cellcrush {

struct Scene;
struct State;

/// A device does not answer, or has no memory left. What runs on it is lost; its newest state on the processor is not.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A crush in the memory of a device.
class CrushOnDevice {
 public:
  CrushOnDevice() = default;
  virtual ~CrushOnDevice() = default;
  CrushOnDevice(const CrushOnDevice&) = delete;
  CrushOnDevice& operator=(const CrushOnDevice&) = delete;

  /// Advances by some steps. Returns why the processor has to take these steps: walls have crossed, or a list had no
  /// room. The crush is then of no use. Throws DeviceError.
  virtual std::optional<std::string> advance(std::int64_t steps) = 0;

  /// Overwrites a state of the scene by that of the crush, with the bits that it has on a processor with fused
  /// multiply-add. Only the lists of the contact search are left out: it begins again, which changes no motion. Throws
  /// DeviceError.
  virtual void take(State& state) const = 0;
};

/// Advances crushes on a device (core/device/README.md).
class DeviceEngine {
 public:
  DeviceEngine() = default;
  virtual ~DeviceEngine() = default;
  DeviceEngine(const DeviceEngine&) = delete;
  DeviceEngine& operator=(const DeviceEngine&) = delete;

  /// Of the device, as its maker calls it.
  [[nodiscard]] virtual std::string name() const = 0;

  /// Copies a scene and a state to the device. Both must outlive the crush; the state may change. Throws DeviceError.
  /// REQUIRES: !why_not_on_device(scene).
  virtual std::unique_ptr<CrushOnDevice> begin(const Scene& scene, const State& state) = 0;
};

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

/// Tells the memory of a crush apart from that of another version.
std::size_t layout_of_crush();

/// An engine on a device. All functions here are in the library cellcrush_device.
std::unique_ptr<DeviceEngine> make_engine(std::unique_ptr<Device> device);

/// A device that is emulated: the items of a phase are computed by three threads, in another order every time, and its
/// memory is filled with bits of no number.
std::unique_ptr<Device> make_emulated_device();

/// Why no device can advance a scene, as the end of a sentence; nothing if one can.
std::optional<std::string> why_not_on_device(const Scene& scene);

}  // namespace cellcrush
