// Writes VTK's XML formats: an unstructured grid (.vtu) or polydata (.vtp) of triangles, with double positions.
//
// The arrays follow the XML as raw little-endian bytes, each after its length. The XML holds their offsets from the
// mark '_'. Metadata are written as comments: programs accept different text arrays among the data.

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "io/mesh/file_bytes.h"
#include "io/mesh/mesh_file.h"

namespace scarp::io {
namespace {

constexpr std::uint8_t kTriangleCell = 5;  // VTK's number of this cell type

/// Assigns the offsets of arrays in the order of the XML.
class VtkPlaces {
 public:
  std::string element(const char* type, const std::string& name, std::size_t components, std::uint64_t bytes) {
    std::string text = fmt::format("<DataArray type=\"{}\" Name=\"{}\"", type, name);
    if (components > 1) text += fmt::format(" NumberOfComponents=\"{}\"", components);
    text += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", next_);
    next_ += sizeof(std::uint64_t) + bytes;
    return text;
  }
  std::uint64_t size() const { return next_; }

 private:
  std::uint64_t next_ = 0;
};

/// Escapes double hyphens, which would end a comment in XML.
std::string comment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
    text.replace(at, 2, "-%2D");
  }
  return fmt::format("  <!-- {} -->\n", text);
}

std::string metadata_comments(const Mesh& mesh) {
  std::string text = comment("Terrain by Scarp: x east, y north, z up; triangles counter-clockwise from above");
  if (mesh.origin != std::array<double, 3>{}) text += comment("scarp.origin: " + origin_text(mesh.origin));
  for (const auto& [key, value] : mesh.metadata) text += comment("scarp " + ascii_metadata_line(key, value));
  return text;
}

template <class T>
void store_header(std::uint8_t*& at, std::uint64_t count) {
  store_number(at, count * sizeof(T));
}

template <class T>
void store_corners(std::uint8_t*& at, const Mesh& mesh) {
  store_header<T>(at, mesh.triangles.size());
  for (const std::uint32_t vertex : mesh.triangles) store_number(at, static_cast<T>(vertex));
  store_header<T>(at, mesh.triangle_count());
  for (std::size_t end = 3; end <= mesh.triangles.size(); end += 3) store_number(at, static_cast<T>(end));
}

void store_point_data(std::uint8_t*& at, const Mesh& mesh) {
  const std::size_t count = mesh.vertex_count();
  if (!mesh.normals.empty()) {
    store_header<float>(at, mesh.normals.size());
    for (const float part : mesh.normals) store_number(at, part);
  }
  if (!mesh.uvs.empty()) {
    store_header<double>(at, mesh.uvs.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
      store_number(at, i % 2 == 0 ? double{mesh.uvs[i]} : 1 - double{mesh.uvs[i]});
    }
  }
  if (!mesh.colors.empty()) {
    store_header<std::uint8_t>(at, mesh.colors.size());
    for (const std::uint8_t part : mesh.colors) store_number(at, part);
  }
  const auto channels = static_cast<std::size_t>(mesh.channel_count);
  for (std::size_t c = 0; c < channels; ++c) {
    store_header<float>(at, count);
    for (std::size_t v = 0; v < count; ++v) store_number(at, mesh.channels[channels * v + c]);
  }
}

std::string point_data_elements(const Mesh& mesh, VtkPlaces& places) {
  const std::uint64_t count = mesh.vertex_count();
  std::string names, arrays;
  const auto add = [&](const char* type, const std::string& name, std::size_t components, std::size_t size) {
    arrays += "        " + places.element(type, name, components, count * components * size);
  };
  if (!mesh.normals.empty()) {
    names += " Normals=\"Normals\"";
    add("Float32", "Normals", 3, sizeof(float));
  }
  if (!mesh.uvs.empty()) {
    names += " TCoords=\"TCoords\"";
    add("Float64", "TCoords", 2, sizeof(double));
  }
  if (!mesh.colors.empty()) {
    names += " Scalars=\"Colors\"";
    add("UInt8", "Colors", 3, 1);
  }
  for (int c = 1; c <= mesh.channel_count; ++c) add("Float32", fmt::format("channel_{}", c), 1, sizeof(float));
  return arrays.empty() ? "" : fmt::format("      <PointData{}>\n{}      </PointData>\n", names, arrays);
}

std::vector<std::uint8_t> encode(const Mesh& mesh, bool as_polydata) {
  const std::uint64_t vertices = mesh.vertex_count(), triangles = mesh.triangle_count();
  const bool wide = mesh.triangles.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  const char* const id_type = wide ? "Int64" : "Int32";
  const std::uint64_t id_size = wide ? 8 : 4;
  const char* const kind = as_polydata ? "PolyData" : "UnstructuredGrid";
  const char* const cells = as_polydata ? "Polys" : "Cells";

  VtkPlaces places;
  std::string header = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n{}  <{}>\n",
      kind, metadata_comments(mesh), kind);
  header += as_polydata ? fmt::format(
                              "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                              "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
                              vertices, triangles)
                        : fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", vertices, triangles);
  header += point_data_elements(mesh, places);
  header += "      <Points>\n        " + places.element("Float64", "Points", 3, vertices * 24) + "      </Points>\n";
  header += fmt::format("      <{}>\n", cells);
  header += "        " + places.element(id_type, "connectivity", 1, triangles * 3 * id_size);
  header += "        " + places.element(id_type, "offsets", 1, triangles * id_size);
  if (!as_polydata) header += "        " + places.element("UInt8", "types", 1, triangles);
  header += fmt::format("      </{}>\n    </Piece>\n  </{}>\n  <AppendedData encoding=\"raw\">\n   _", cells, kind);
  constexpr std::string_view kFooter = "\n  </AppendedData>\n</VTKFile>\n";

  std::vector<std::uint8_t> bytes(header.size() + places.size() + kFooter.size());
  std::memcpy(bytes.data(), header.data(), header.size());
  std::uint8_t* at = bytes.data() + header.size();
  store_point_data(at, mesh);
  store_header<double>(at, mesh.positions.size());
  for (std::size_t v = 0; v < vertices; ++v) {
    for (const double coordinate : mesh.vertex(v)) store_number(at, coordinate);
  }
  if (wide) {
    store_corners<std::int64_t>(at, mesh);
  } else {
    store_corners<std::int32_t>(at, mesh);
  }
  if (!as_polydata) {
    store_header<std::uint8_t>(at, triangles);
    std::memset(at, kTriangleCell, triangles);
    at += triangles;
  }
  std::memcpy(at, kFooter.data(), kFooter.size());
  return bytes;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_vtu(const Mesh& mesh) { return encode(mesh, false); }

Result<std::vector<std::uint8_t>> encode_vtp(const Mesh& mesh) { return encode(mesh, true); }

}  // namespace scarp::io
