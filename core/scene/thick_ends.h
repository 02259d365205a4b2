#pragma once

#include "cellcrush/scene.h"
#include "scene/face_loops.h"

namespace cellcrush {

/// Appends to each loop its thick ends: elements that end at a corner of the loop without bordering its face, and are
/// thicker than both walls of the face there. Only their round ends stand out into the face. Of a thick end, `particle`
/// is the end that is not the corner. REQUIRES: incidence; loops as traced, none of which passes a particle twice.
void append_thick_ends(const Scene& scene, FaceLoops& loops);

}  // namespace cellcrush
