// Reports of `scarp info` on a raster, points or a mesh.
#pragma once

#include <cstdint>
#include <string>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/mesh.h"
#include "scarp/simplify.h"
#include "session/text/json.h"

namespace scarp::cli {

/// A mesh file.
struct MeshFile {
  std::string path, format;
  std::uint64_t bytes = 0;
  Mesh mesh;
  MeshFileAxes axes;
};

std::string raster_facts(const OwnedHeightField& field);
/// The table below the facts.
std::string suggestion_table(const OwnedHeightField& field, const Suggestions& suggestions);
/// Omits the rows of suggestions if none were requested.
Json raster_report(const OwnedHeightField& field, const Suggestions& suggestions, int band,
                   const std::string& command_line);

/// `inputs`: the files of the points.
std::string points_facts(const PointSet& points, const std::vector<std::string>& inputs);
Json points_facts_report(const PointSet& points, const std::string& command_line);

std::string mesh_facts(const MeshFile& file);
Json mesh_facts_report(const MeshFile& file, const std::string& command_line);

}  // namespace scarp::cli
