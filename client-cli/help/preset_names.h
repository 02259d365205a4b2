#pragma once

#include <array>

namespace cellcrush::client {

/// The server's presets, for completion without a server; a test compares them with `cellcrush presets`.
constexpr std::array kPresetNames = {
    "hexagon-small",     "papka-kyriakides-1", "papka-kyriakides-2", "type-i",
    "type-ii-as-stated", "type-ii-as-counted", "type-iii-as-stated", "type-iii-as-counted",
    "inclusions-0",      "inclusions-2",       "inclusions-6"};

}  // namespace cellcrush::client
