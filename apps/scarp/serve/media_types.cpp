#include "serve/media_types.h"

#include <algorithm>

#include "scarp/io.h"
#include "serve/http_message.h"

namespace scarp::cli {
namespace {

struct MediaType {
  std::string_view ending, type;
};

constexpr MediaType kMediaTypes[] = {
    // Pages.
    {"html", "text/html; charset=utf-8"},
    {"htm", "text/html; charset=utf-8"},
    {"css", "text/css; charset=utf-8"},
    {"js", "text/javascript; charset=utf-8"},
    {"mjs", "text/javascript; charset=utf-8"},
    {"cjs", "text/javascript; charset=utf-8"},
    {"wasm", "application/wasm"},
    {"map", "application/json"},
    {"webmanifest", "application/manifest+json"},
    {"woff", "font/woff"},
    {"woff2", "font/woff2"},
    {"ttf", "font/ttf"},
    {"otf", "font/otf"},
    // Images, sound and video.
    {"svg", "image/svg+xml"},
    {"png", "image/png"},
    {"apng", "image/apng"},
    {"jpg", "image/jpeg"},
    {"jpeg", "image/jpeg"},
    {"gif", "image/gif"},
    {"webp", "image/webp"},
    {"avif", "image/avif"},
    {"ico", "image/vnd.microsoft.icon"},
    {"bmp", "image/bmp"},
    {"tif", "image/tiff"},
    {"tiff", "image/tiff"},
    {"ktx", "image/ktx"},
    {"ktx2", "image/ktx2"},
    {"mp3", "audio/mpeg"},
    {"ogg", "audio/ogg"},
    {"mp4", "video/mp4"},
    {"webm", "video/webm"},
    // Texts and data.
    {"txt", "text/plain; charset=utf-8"},
    {"md", "text/markdown; charset=utf-8"},
    {"csv", "text/csv; charset=utf-8"},
    {"xml", "application/xml"},
    {"json", "application/json"},
    {"jsonl", "application/jsonl"},
    {"geojson", "application/geo+json"},
    {"topojson", "application/json"},
    {"czml", "application/json"},
    {"yaml", "application/yaml"},
    {"yml", "application/yaml"},
    {"pdf", "application/pdf"},
    {"kml", "application/vnd.google-earth.kml+xml"},
    {"kmz", "application/vnd.google-earth.kmz"},
    {"gpx", "application/gpx+xml"},
    // Tiles and models.
    {"terrain", "application/vnd.quantized-mesh"},
    {"gltf", "model/gltf+json"},
    {"pbf", "application/x-protobuf"},
    {"mvt", "application/vnd.mapbox-vector-tile"},
    {"pmtiles", "application/vnd.pmtiles"},
    {"mbtiles", "application/vnd.sqlite3"},
    // Archives.
    {"zip", "application/zip"},
    {"3tz", "application/zip"},
    {"gz", "application/gzip"},
    {"tgz", "application/gzip"},
    // Meshes: scarp/io.h.
    // "b3dm", "i3dm", "pnts", "cmpt" and "subtree" of 3D Tiles have no registered type.
};

}  // namespace

std::string_view media_type_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  const std::string ending = dot == std::string_view::npos ? std::string() : lowered(name.substr(dot + 1));
  const auto* const found = std::ranges::find(kMediaTypes, ending, &MediaType::ending);
  if (found != std::end(kMediaTypes)) return found->type;
  const auto mesh = ending.empty() ? std::nullopt : find_mesh_format(ending);
  const std::string_view type = mesh ? traits_of(*mesh).media_type : "";
  return type.empty() ? "application/octet-stream" : type;
}

}  // namespace scarp::cli
