#pragma once

#include <string>

#include "cellcrush/v1/cases_service.pb.h"
#include "chart/canvas.h"
#include "plots/rigid_walls.h"

namespace cellcrush::client {

/// The specimen between its plates and rigid walls before loading, with a scale bar, its marks and what they mean.
/// REQUIRES: a mesh.
std::string render_preview_picture(PictureFormat format, const std::string& title,
                                   const v1::PreviewCaseResponse& preview, const RigidWalls& rigid_walls,
                                   const PrintSize& print = {});

}  // namespace cellcrush::client
