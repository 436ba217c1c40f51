// Draw height fields, meshes and errors.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(const auto& mesh, scarp::read_mesh("hills.glb"));
//     SCARP_TRY(const auto& picture, scarp::draw_preview(dem, mesh, {.max_side = 600}));
//     SCARP_TRY(const auto& png, scarp::encode_png(picture));
//     SCARP_RETURN_IF_ERROR(scarp::write_file("hills.png", png));
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

enum class MarkKind { kLake, kWater, kBreakline, kRidge, kWall, kCutline };

/// A line marked on a picture. Rings of lakes are filled, even-odd.
struct Mark {
  MarkKind kind = MarkKind::kBreakline;
  std::vector<std::array<double, 2>> points;  ///< columns and rows of samples
};

struct PreviewOptions {
  int max_side = 1400;  ///< largest width or height of the picture, in pixels
  /// Width and height of a cell in metres. DEFAULT: those in the field's frame, without a scale bar.
  std::array<double, 2> cell{0, 0};
  std::string unit = {};  ///< unit of heights, for the legend
  std::vector<Mark> marks = {};
};

/// Draws a hillshade of the field with the mesh's edges and the marks, in true proportions. Edges of triangles that
/// cover only a few pixels are faint. Nodata is white. Tints show heights; heights below 0 are blue, except in fields
/// without a georeference. Pictures of 300 pixels and more have a legend below. Streamed samples are read once, from
/// the top. Memory: 112 bytes a pixel. Fails with kInput for fewer than 2×2 samples, with kUsage for a frame in space,
/// and as the field's source does.
Result<Picture> draw_preview(const HeightField& field, const Mesh& mesh, const PreviewOptions& options = {});

struct ErrorMapOptions {
  double limit = 0;                  ///< end of the scale; <= 0: the largest |error|
  int max_side = 1400;               ///< largest width or height of the picture, in pixels
  std::array<double, 2> cell{0, 0};  ///< width and height of a cell. DEFAULT: 0, a square
  std::string unit = {};             ///< unit of errors
  std::string title = {};            ///< above the map
};

/// Draws signed errors (row-major, cols·rows, NaN = nodata or uncovered) in diverging colours, with a scale from −limit
/// to +limit in z units. The mesh is below the samples where the map is blue, and above them where it is red.
Picture draw_error_map(std::span<const float> errors, int cols, int rows, const ErrorMapOptions& options = {});
/// Draws the same map from errors added row by row. Memory: 7 bytes a pixel. REQUIRES: at least 1×1 samples.
class ErrorMap {
 public:
  ErrorMap(int cols, int rows, ErrorMapOptions options = {});
  void add(int row, std::span<const float> errors);
  Picture draw() const;

 private:
  int cols_, rows_, width_, height_;
  ErrorMapOptions options_;
  std::array<int, 2> size_;    // size of the map in the picture
  std::vector<float> errors_;  // error of largest absolute value in each pixel; NaN: none
  double largest_ = 0;
};

/// Draws the mesh with one pixel for each sample, Gouraud-shaded: its colours or, without colours, its hillshade is
/// interpolated in each triangle. Pixels outside the mesh are white. REQUIRES: the mesh lies in the field's frame,
/// which is not in space.
Picture draw_gouraud(const HeightField& field, const Mesh& mesh);

/// Channels as a picture: three as red, green, blue, else the first as grey. 8-bit values do not change, and others are
/// stretched over their range.
Picture draw_channels(const OwnedChannels& channels);

/// Fills mesh.colors from the mesh's channels, with the colours of draw_channels().
void color_by_channels(Mesh& mesh, const OwnedChannels& channels);

/// Peak signal-to-noise ratio in dB over all pixels and colours; +infinity for equal pictures. REQUIRES: equal sizes.
double find_psnr(const Picture& a, const Picture& b);

/// Pictures side by side, aligned at the top, with white gaps of `gap` pixels.
Picture place_side_by_side(std::span<const Picture> pictures, int gap = 8);

/// Draws each edge of the mesh once, seen from above, to scale, with north up. Returns deterministic text.
std::vector<std::uint8_t> encode_svg(const Mesh& mesh);
std::vector<std::uint8_t> encode_eps(const Mesh& mesh);

// The normals of a raster as an image.

/// Unit normals of the field's surface, in its frame, as a tangent-space normal map (GlbOptions::normal_map): red x,
/// green y, blue z, each as 255 (n + 1) / 2. The picture covers the raster; its longer side has `side` pixels, but at
/// most one for each sample. A pixel is the mean of the normals of its samples. Nodata is (0, 0, 1). Streamed samples
/// are read once, from the top. Fails as the field's source does, and with kUsage for a side below 1 and for a frame in
/// space.
Result<Picture> draw_normal_map(const HeightField& field, int side);

}  // namespace scarp

#pragma GCC visibility pop
