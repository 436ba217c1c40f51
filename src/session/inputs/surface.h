// Surfaces whose volumes are compared, brought into one frame.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scarp/mesh.h"
#include "scarp/result.h"
#include "session/options/surfaces.h"

namespace scarp::cli {

/// A mesh or a level.
struct Surface {
  GivenSurface given;
  Mesh mesh;                        ///< empty for a level
  std::optional<double> max_error;  ///< its heights are known to that: by the file's metadata, 0 for a level
};

/// The units of the frame in which surfaces are compared, as words for one line: "m³"; "cubic units" where x and y, or
/// z, are in no unit that is known.
struct SurfaceUnits {
  std::string volume, area, height;
  bool are_known = false;
};

/// The mesh of the file, z up; nothing is read for a level. `is_y_up`: of files that do not declare which axis is up.
/// kInput as read_mesh(), and for a raster, a mesh in space, and one in degrees.
Result<Surface> read_surface(const GivenSurface& given, bool is_y_up);

/// False for a mesh whose file does not hold where it lies.
bool has_place(const Surface& surface);

/// Moves the second mesh into the frame of the first, by the places that their files hold. A file that holds
/// none is in the frame of the other. kInput for frames, or units of heights, between which there is no way.
Result<SurfaceUnits> settle_frames(std::array<Surface, 2>& surfaces);

}  // namespace scarp::cli
