// Boundaries of LandXML as polygons.
#pragma once

#include <string>

#include "io/gdal/session.h"
#include "scarp/lines.h"

namespace scarp::gdal {

/// The boundaries of a surface: outer boundaries and islands, with voids as their holes. `surface`: its name; if empty,
/// the only one with boundaries. Coordinates and CRS are those of the file. Fails with kInput if there are no
/// boundaries.
Result<LineSet> read_landxml_lines(Session& session, const std::string& path, const std::string& surface,
                                   const ReadLinesOptions& options);

}  // namespace scarp::gdal
