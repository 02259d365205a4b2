#pragma once

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

  /// Advances by some steps. Returns false if one of the lists on the device had no room: the crush is then of no use.
  /// Throws DeviceError.
  virtual bool advance(std::int64_t steps) = 0;

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

/// Opens a device: `cuda`, the path of a library for another one, or `emulated`, which is slow and for tests. Throws
/// DeviceError. In the library cellcrush_device.
std::unique_ptr<DeviceEngine> open_device(const std::string& name);

/// Why no device can advance a scene, as the end of a sentence; nothing if one can.
std::optional<std::string> why_not_on_device(const Scene& scene);

}  // namespace cellcrush
