#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "connection/frames.h"

namespace cellcrush::client {

/// How the files of the frames describe the walls: as lines (.vtp), which ParaView's filter Tube requires, or as a grid
/// of line cells (.vtu), which meshio reads too. ParaView opens both.
enum class VtkKind { lines, grid };

/// "vtp" or "vtu".
const char* extension_of(VtkKind kind);

/// How all files of VTK begin that this program writes.
inline constexpr std::string_view kVtkStart = "<?xml version=\"1.0\"?><!-- cellcrush -->";

/// A frame as XML of VTK, compressed: particles with displacement_mm from the undeformed frame, elements with
/// thickness_mm and plastic_fraction, and time and strain of the whole.
std::string vtk_frame(const MeshFrame& frame, const v1::FieldFrame& undeformed, VtkKind kind);

/// A ParaView collection of files, each with its time in s.
std::string vtk_collection(const std::vector<std::pair<double, std::string>>& files);

}  // namespace cellcrush::client
