#include "worker/open_device.h"

#include <dlfcn.h>

namespace cellcrush::worker {
namespace {

/// The library stays loaded: a device's driver does not survive being unloaded.
std::unique_ptr<Device> load(const std::string& library) {
  void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr) throw DeviceError(std::string("The library cannot be loaded: ") + dlerror() + ".");
  using Open = Device*();
  auto* const open = reinterpret_cast<Open*>(dlsym(loaded, "cellcrush_open_device"));
  if (open == nullptr) throw DeviceError(library + " is no library for a device.");
  return std::unique_ptr<Device>(open());
}

}  // namespace

std::unique_ptr<DeviceEngine> open_device(const std::string& name) {
  if (name == "emulated") return make_engine(make_emulated_device());
  return make_engine(load(name == "cuda" ? "libcellcrush_cuda.so" : name));
}

}  // namespace cellcrush::worker
