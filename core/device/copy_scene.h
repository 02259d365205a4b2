#pragma once

#include "cellcrush/scene.h"
#include "device/crush-inl.h"
#include "device/device_memory.h"

namespace cellcrush {

/// Copies to a device what a crush reads of a scene and never changes. Returns the kind of its walls
/// (device/steps-inl.h).
int copy_scene(const Scene& scene, DeviceMemory& memory, HWY_NAMESPACE::Crush& crush);

}  // namespace cellcrush
