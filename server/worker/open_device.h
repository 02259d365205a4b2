#pragma once

#include <memory>
#include <string>

#include "cellcrush/device.h"

namespace cellcrush::worker {

/// Opens a device: `cuda`, the path of a library for another one, or `emulated`, which is slow and for tests. A library
/// has a function `extern "C" cellcrush::Device* cellcrush_open_device()`. Throws DeviceError.
std::unique_ptr<DeviceEngine> open_device(const std::string& name);

}  // namespace cellcrush::worker
