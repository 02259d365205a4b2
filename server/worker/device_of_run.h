#pragma once

#include <memory>
#include <string>

#include "cellcrush/device.h"
#include "cellcrush/simulation.h"

namespace cellcrush::worker {

/// Opens a device: `cuda`, the path of a library for another one, or `emulated`, which is slow and for tests. A library
/// has the functions `extern "C" cellcrush::Device* cellcrush_open_device()` and, of the same version as this program,
/// `extern "C" std::size_t cellcrush_device_layout()` (layout_of_crush). Throws DeviceError.
std::unique_ptr<DeviceEngine> open_device(const std::string& name);

/// What a device has done of a run. The numbers are those of Final.
enum class DeviceUse { no_device = 0, advanced = 1, left_to_processor = 2 };

/// The device that advances a run, if its order names one and it can. Must outlive the simulation.
class DeviceOfRun {
 public:
  /// `name`: of open_device; empty: none.
  DeviceOfRun(const std::string& name, const Scene& scene);

  /// Whether there is one.
  [[nodiscard]] bool advances() const { return engine_ != nullptr; }
  void advance(Simulation& simulation) const;

  /// What advanced the run beside the processor, or why nothing did.
  [[nodiscard]] DeviceUse use(const Simulation& simulation) const;
  [[nodiscard]] std::string words(const Simulation& simulation) const;

 private:
  std::unique_ptr<DeviceEngine> engine_;
  std::string why_not_;
};

}  // namespace cellcrush::worker
