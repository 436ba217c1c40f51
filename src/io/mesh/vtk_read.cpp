// Reads VTK's XML formats: the triangles and polygons of uncompressed unstructured grids and polydata, with any array
// types, encodings and byte order.
//
// The XML is read first, and the arrays of each piece are recorded. Then the arrays are read, since their raw bytes
// follow the XML.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/vtk_arrays.h"
#include "io/mesh/xml_reader.h"
#include "scarp/height_field.h"

namespace scarp::io {
namespace {

/// A Piece element. Keys of arrays are "Section/Name", such as "Polys/offsets"; the key of the points' only array is
/// "Points".
struct VtkPiece {
  std::int64_t points = 0, cells = 0;
  std::map<std::string, VtkArray> arrays;
  std::string normals, uvs;  // names of arrays in PointData
};

/// VTK's numbers of cell types.
constexpr int kLastLine = 4, kTriangle = 5, kPolygon = 7, kPixel = 8, kQuad = 9;

class VtkReader {
 public:
  explicit VtkReader(std::span<const std::uint8_t> bytes) : bytes_(bytes), xml_(bytes) {}

  Mesh mesh;

  /// Returns a complaint, or an empty string.
  std::string read() {
    if (std::string why = read_xml(); !why.empty()) return why;
    if (pieces_.empty()) return "it holds no piece of a mesh";
    for (const VtkPiece& piece : pieces_) {
      if (std::string why = add_piece(piece); !why.empty()) return why;
    }
    if (origin_ && find_unreadable(mesh).empty()) set_origin(mesh, *origin_);
    return {};
  }

 private:
  std::string read_xml() {
    std::vector<std::string> path;
    std::string array_key;
    for (;;) {
      switch (xml_.next()) {
        case XmlReader::Event::kStart: {
          std::string why = begin_element(path, array_key);
          if (!why.empty()) return why;
          path.emplace_back(xml_.name());
          break;
        }
        case XmlReader::Event::kEnd:
          path.pop_back();
          if (xml_.name() == "DataArray") array_key.clear();
          break;
        case XmlReader::Event::kText:
          if (!array_key.empty()) pieces_.back().arrays[array_key].content += xml_.text();
          break;
        case XmlReader::Event::kComment:
          read_comment(xml_.text());
          break;
        case XmlReader::Event::kDone:
          return {};
        case XmlReader::Event::kBroken:
          return xml_.complaint();
      }
    }
  }

  void read_comment(std::string_view text) {
    constexpr std::string_view kOrigin = "scarp.origin: ", kKey = "scarp ";
    if (text.starts_with(' ')) text.remove_prefix(1);
    if (text.ends_with(' ')) text.remove_suffix(1);
    if (text.starts_with(kOrigin)) {
      origin_ = parse_origin(text.substr(kOrigin.size()));
    } else if (text.starts_with(kKey)) {
      parse_metadata_line(text.substr(kKey.size()), mesh.metadata);
    }
  }

  std::string begin_element(const std::vector<std::string>& path, std::string& array_key) {
    const std::string_view name = xml_.name();
    if (path.empty()) return begin_file();
    if (path.size() == 1 && name == "AppendedData") return skip_appended();
    if (name == "Piece" && path.size() == 2) {
      pieces_.emplace_back();
      VtkPiece& piece = pieces_.back();
      if (!parse_integer(xml_.attribute("NumberOfPoints"), piece.points)) return "a piece does not count its points";
      const std::string cells = xml_.attribute(is_polydata_ ? "NumberOfPolys" : "NumberOfCells");
      if (!parse_integer(cells, piece.cells)) return "a piece does not count its cells";
      std::int64_t strips = 0;
      parse_integer(xml_.attribute("NumberOfStrips"), strips);
      if (strips > 0) return "its triangles stand in strips, which are not read";
    }
    if (path.size() < 3 || path[2] != "Piece") return {};
    if (path.size() == 3 && name == "PointData") {
      pieces_.back().normals = xml_.attribute("Normals");
      pieces_.back().uvs = xml_.attribute("TCoords");
    }
    if (path.size() == 4 && name == "DataArray") return begin_array(path[3], array_key);
    return {};
  }

  std::string begin_file() {
    const std::string type = xml_.attribute("type");
    is_polydata_ = type == "PolyData";
    if (!is_polydata_ && type != "UnstructuredGrid") {
      return fmt::format("it is VTK's {}, and neither PolyData nor UnstructuredGrid", in_quotes(type));
    }
    if (const std::string how = xml_.attribute("compressor"); !how.empty()) {
      return fmt::format("its arrays are compressed ({}): write it without compression", in_quotes(how));
    }
    file_.order = xml_.attribute("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    file_.wide_lengths = xml_.attribute("header_type") == "UInt64";
    return {};
  }

  std::string begin_array(const std::string& section, std::string& array_key) {
    VtkArray array;
    const std::string type = xml_.attribute("type"), format = xml_.attribute("format");
    const auto found = find_vtk_type(type);
    if (!found) return {};  // text, or bits: no mesh data
    array.type = *found;
    if (format == "appended") {
      const std::string text = xml_.attribute("offset");
      std::int64_t offset = 0;  // VTK pads it with blanks
      if (!parse_integer(std::string_view(text).substr(0, text.find(' ')), offset) || offset < 0) {
        return "an array does not say where it is";
      }
      array.format = VtkArray::Format::kAppended;
      array.offset = static_cast<std::uint64_t>(offset);
    } else if (format == "binary") {
      array.format = VtkArray::Format::kBase64;
    } else if (format != "ascii" && !format.empty()) {
      return fmt::format("an array has the unknown format {}", in_quotes(format));
    }
    array_key = section == "Points" ? section : section + "/" + xml_.attribute("Name");
    pieces_.back().arrays[array_key] = std::move(array);
    if (array.format == VtkArray::Format::kAppended) array_key.clear();
    return {};
  }

  /// Skips from the mark to the end tag. The tag follows arbitrary bytes, so the search begins at the end of the file.
  std::string skip_appended() {
    file_.is_base64 = xml_.attribute("encoding") == "base64";
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    const std::size_t mark = text.find('_', xml_.position());
    const std::size_t end = text.rfind("</AppendedData");
    if (mark == std::string_view::npos || end == std::string_view::npos || end <= mark) {
      return "it ends within its arrays: it was cut off";
    }
    file_.appended = bytes_.subspan(mark + 1, end - mark - 1);
    xml_.jump(end);
    return {};
  }

  /// The numbers of a required array. Arrays that share bytes are rejected, since a small file could then request much
  /// memory.
  Result<VtkNumbers> load(const VtkPiece& piece, const std::string& key) {
    const auto found = piece.arrays.find(key);
    if (found == piece.arrays.end()) return fail(ErrorKind::kInput, fmt::format("it has no array {}", in_quotes(key)));
    auto numbers = read_vtk_array(file_, found->second);
    if (!numbers) {
      return fail(ErrorKind::kInput, fmt::format("its array {} {}", in_quotes(key), numbers.error().message));
    }
    if (found->second.format == VtkArray::Format::kAppended) loaded_ += numbers->bytes();
    if (loaded_ > bytes_.size()) return fail(ErrorKind::kInput, "its arrays overlap");
    return numbers;
  }

  std::string add_piece(const VtkPiece& piece) {
    if (piece.points == 0 || piece.cells == 0) return {};
    const auto points = load(piece, "Points");
    if (!points) return points.error().message;
    if (piece.points < 0 || points->size() / 3 != static_cast<std::uint64_t>(piece.points) || points->size() % 3 != 0) {
      return fmt::format("a piece announces {} points and has {}", piece.points, points->size() / 3);
    }
    const std::size_t first = mesh.vertex_count();
    if (first + points->size() / 3 > std::numeric_limits<std::uint32_t>::max()) {
      return "it has more points than 32 bits can number";
    }
    mesh.positions.reserve(mesh.positions.size() + points->size());
    for (std::size_t i = 0; i < points->size(); ++i) mesh.positions.push_back(points->real(i));
    if (std::string why = add_cells(piece, static_cast<std::uint32_t>(first)); !why.empty()) return why;
    return pieces_.size() == 1 ? add_point_data(piece) : std::string();
  }

  std::string add_cells(const VtkPiece& piece, std::uint32_t first) {
    const std::string section = is_polydata_ ? "Polys/" : "Cells/";
    const auto connectivity = load(piece, section + "connectivity");
    if (!connectivity) return connectivity.error().message;
    const auto offsets = load(piece, section + "offsets");
    if (!offsets) return offsets.error().message;
    Result<VtkNumbers> types = VtkNumbers();
    if (!is_polydata_) types = load(piece, section + "types");
    if (!types) return types.error().message;
    const auto cells = static_cast<std::uint64_t>(piece.cells);
    if (piece.cells < 0 || offsets->size() != cells || (!is_polydata_ && types->size() != cells)) {
      return fmt::format("a piece announces {} cells and has {}", piece.cells, offsets->size());
    }
    std::vector<std::uint32_t> corners;
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const std::int64_t end = offsets->whole(cell);
      if (end < begin || static_cast<std::uint64_t>(end) > connectivity->size()) {
        return fmt::format("cell {} (counting from 0) has no end among the corners", cell);
      }
      corners.clear();
      for (std::int64_t k = begin; k < end; ++k) {
        const std::int64_t point = connectivity->whole(static_cast<std::size_t>(k));
        if (point < 0 || point >= piece.points) {
          return fmt::format("cell {} (counting from 0) names point {}, and there are {}", cell, point, piece.points);
        }
        corners.push_back(first + static_cast<std::uint32_t>(point));
      }
      begin = end;
      const std::int64_t type = is_polydata_ ? kPolygon : types->whole(cell);
      if (type >= 0 && type <= kLastLine) continue;
      const bool is_face = type == kTriangle || type == kPolygon || type == kPixel || type == kQuad;
      if (!is_face) return fmt::format("cell {} (counting from 0) is of kind {}, which is no polygon", cell, type);
      if (corners.size() < 3) return fmt::format("cell {} (counting from 0) lacks a corner", cell);
      if (type == kPixel && corners.size() == 4) std::swap(corners[2], corners[3]);
      if (auto wrong = append_fan(corners, mesh.triangles); !wrong.empty()) return wrong;
    }
    return {};
  }

  static float as_float(double value) {
    return std::fabs(value) <= double{std::numeric_limits<float>::max()} ? static_cast<float>(value)
                                                                         : std::numeric_limits<float>::quiet_NaN();
  }

  /// An array with `components` numbers per point. Empty if the piece has no such array, or the array does not cover
  /// all points.
  Result<VtkNumbers> load_point_data(const VtkPiece& piece, const std::string& name, std::size_t components) {
    const std::string key = "PointData/" + name;
    if (piece.arrays.find(key) == piece.arrays.end()) return VtkNumbers();
    auto numbers = load(piece, key);
    if (numbers && numbers->size() != components * mesh.vertex_count()) return VtkNumbers();
    return numbers;
  }

  std::string add_point_data(const VtkPiece& piece) {
    const auto normals = load_point_data(piece, piece.normals, 3);
    if (!normals) return normals.error().message;
    for (std::size_t i = 0; i < normals->size(); ++i) mesh.normals.push_back(as_float(normals->real(i)));
    const auto uvs = load_point_data(piece, piece.uvs, 2);
    if (!uvs) return uvs.error().message;
    for (std::size_t i = 0; i < uvs->size(); ++i) {
      mesh.uvs.push_back(as_float(i % 2 == 0 ? uvs->real(i) : 1 - uvs->real(i)));  // VTK's images start at the bottom
    }
    const auto is_nan = [](float part) { return std::isnan(part); };
    if (std::any_of(mesh.normals.begin(), mesh.normals.end(), is_nan)) return "a normal is not finite";
    if (std::any_of(mesh.uvs.begin(), mesh.uvs.end(), is_nan)) return "a place in the image is not finite";
    if (std::string why = add_colors(piece); !why.empty()) return why;
    return add_channels(piece);
  }

  std::string add_colors(const VtkPiece& piece) {
    const auto array = piece.arrays.find("PointData/Colors");
    if (array == piece.arrays.end() || array->second.type != VtkType::kUint8) return {};
    const auto colors = load_point_data(piece, "Colors", 3);
    if (!colors) return colors.error().message;
    for (std::size_t i = 0; i < colors->size(); ++i) mesh.colors.push_back(static_cast<std::uint8_t>(colors->whole(i)));
    return {};
  }

  std::string add_channels(const VtkPiece& piece) {
    std::vector<VtkNumbers> channels;
    while (channels.size() < static_cast<std::size_t>(kMaxChannels)) {
      auto channel = load_point_data(piece, fmt::format("channel_{}", channels.size() + 1), 1);
      if (!channel) return channel.error().message;
      if (channel->size() == 0) break;
      channels.push_back(std::move(*channel));
    }
    mesh.channel_count = static_cast<int>(channels.size());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      for (const VtkNumbers& channel : channels) mesh.channels.push_back(as_float(channel.real(v)));
    }
    return {};
  }

  std::span<const std::uint8_t> bytes_;
  XmlReader xml_;
  VtkFile file_;
  bool is_polydata_ = false;
  std::vector<VtkPiece> pieces_;
  std::size_t loaded_ = 0;  // bytes of arrays after the XML
  std::optional<std::array<double, 3>> origin_;
};

}  // namespace

Result<Mesh> decode_vtk(std::span<const std::uint8_t> bytes) {
  VtkReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
