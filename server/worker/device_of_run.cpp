#include "worker/device_of_run.h"

#include <optional>

#include "cellcrush/simd.h"
#include "worker/open_device.h"

namespace cellcrush::worker {

DeviceOfRun::DeviceOfRun(const std::string& name, const Scene& scene) {
  if (name.empty()) return;
  if (simd_target() == "scalar") {
    why_not_ = "the scalar kernel rounds otherwise than a device";
  } else if (const std::optional<std::string> reason = why_not_on_device(scene)) {
    why_not_ = *reason;
  } else {
    try {
      engine_ = open_device(name);
    } catch (const DeviceError& error) {
      why_not_ = error.what();
    }
  }
}

void DeviceOfRun::advance(Simulation& simulation) const {
  if (engine_) simulation.use_device(*engine_);
}

std::string DeviceOfRun::words(const Simulation& simulation) const {
  if (!engine_) return why_not_.empty() ? "none" : "none: " + why_not_;
  const std::string& failure = simulation.device_failure();
  return failure.empty() ? engine_->name() : engine_->name() + ", until it failed: " + failure;
}

}  // namespace cellcrush::worker
