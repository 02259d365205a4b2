#pragma once

namespace cellcrush {

/// A spec has m, a scene has mm.
inline constexpr double kMmPerM = 1e3;

}  // namespace cellcrush
