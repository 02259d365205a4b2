#include "worker/device_of_run.h"

#include <dlfcn.h>

#include <cstddef>
#include <optional>

#include "cellcrush/simd.h"

namespace cellcrush::worker {
namespace {

/// The library stays loaded: a device's driver does not survive being unloaded.
std::unique_ptr<Device> load(const std::string& library) {
  void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr) throw DeviceError(std::string("The library cannot be loaded: ") + dlerror() + ".");
  using Open = Device*();
  using Layout = std::size_t();
  auto* const open = reinterpret_cast<Open*>(dlsym(loaded, "cellcrush_open_device"));
  auto* const layout = reinterpret_cast<Layout*>(dlsym(loaded, "cellcrush_device_layout"));
  if (open == nullptr || layout == nullptr) throw DeviceError(library + " is no library for a device.");
  if (layout() != layout_of_crush()) throw DeviceError(library + " is of another version: build it again.");
  return std::unique_ptr<Device>(open());
}

}  // namespace

std::unique_ptr<DeviceEngine> open_device(const std::string& name) {
  if (name == "emulated") return make_engine(make_emulated_device());
  return make_engine(load(name == "cuda" ? "libcellcrush_cuda.so" : name));
}

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

DeviceUse DeviceOfRun::use(const Simulation& simulation) const {
  if (engine_) return simulation.device_failure().empty() ? DeviceUse::advanced : DeviceUse::left_to_processor;
  return why_not_.empty() ? DeviceUse::no_device : DeviceUse::left_to_processor;
}

std::string DeviceOfRun::words(const Simulation& simulation) const {
  if (!engine_) return why_not_.empty() ? "none" : "none: " + why_not_;
  const std::string& failure = simulation.device_failure();
  return failure.empty() ? engine_->name() : engine_->name() + ", until it failed: " + failure;
}

}  // namespace cellcrush::worker
