// PLY: a text header that describes the rest. The writer writes absolute positions in binary, little-endian. They are
// floats, which more programs read, if floats are exact, and doubles otherwise. The reader accepts text and both byte
// orders, any numeric types, properties in any order, unknown elements, and polygons.
//
// The reader parses items property by property. Needed values have a slot in a small table; others are skipped.

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "io/mesh/file_bytes.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp::io {
namespace {

constexpr std::string_view kPlyOrigin = "scarp.origin: ", kPlyKey = "scarp ", kCrs = "crs ";

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
constexpr std::size_t kTypeSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct PlyTypeName {
  std::string_view name;
  Type type;
};
constexpr PlyTypeName kTypeNames[] = {
    {"char", Type::kInt8},   {"int8", Type::kInt8},     {"uchar", Type::kUint8},   {"uint8", Type::kUint8},
    {"short", Type::kInt16}, {"int16", Type::kInt16},   {"ushort", Type::kUint16}, {"uint16", Type::kUint16},
    {"int", Type::kInt32},   {"int32", Type::kInt32},   {"uint", Type::kUint32},   {"uint32", Type::kUint32},
    {"float", Type::kFloat}, {"float32", Type::kFloat}, {"double", Type::kDouble}, {"float64", Type::kDouble}};

std::optional<Type> find_type(std::string_view name) {
  for (const PlyTypeName& known : kTypeNames) {
    if (known.name == name) return known.type;
  }
  return {};
}

/// Positions of a vertex's values in the table: x y z, nx ny nz, red green blue, s t, channels.
constexpr int kPosition = 0, kNormal = 3, kColor = 6, kUv = 9, kChannel = 11, kOther = -1;
constexpr int kSlots = kChannel + kMaxChannels;

struct Property {
  Type type = Type::kFloat;
  std::optional<Type> count_type;  // set for a list
  int slot = kOther;
  bool is_corners = false;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

int find_slot(std::string_view property) {
  struct Name {
    std::string_view name;
    int slot;
  };
  constexpr Name kNames[] = {{"x", 0},  {"y", 1},   {"z", 2},     {"nx", 3},        {"ny", 4},
                             {"nz", 5}, {"red", 6}, {"green", 7}, {"blue", 8},      {"s", 9},
                             {"t", 10}, {"u", 9},   {"v", 10},    {"texture_u", 9}, {"texture_v", 10}};
  for (const Name& known : kNames) {
    if (property == known.name) return known.slot;
  }
  constexpr std::string_view kNumbered = "channel_";
  std::int64_t number = 0;
  const bool channel = property.starts_with(kNumbered) && parse_integer(property.substr(kNumbered.size()), number);
  return channel && number >= 1 && number <= kMaxChannels ? kChannel + static_cast<int>(number) - 1 : kOther;
}

/// Converts 0 … 1, or integers up to the type's largest, to a byte.
std::uint8_t to_color(double value, Type type) {
  if (type == Type::kFloat || type == Type::kDouble) value *= 255;
  if (type == Type::kUint16) value /= 257;
  return value > 0 ? static_cast<std::uint8_t>(std::min(value, 255.0) + 0.5) : std::uint8_t{0};
}

float to_float(double value) {
  return std::fabs(value) <= double{std::numeric_limits<float>::max()} ? static_cast<float>(value)
                                                                       : std::numeric_limits<float>::quiet_NaN();
}

class PlyReader {
 public:
  explicit PlyReader(std::span<const std::uint8_t> bytes) : cursor_(bytes), end_(bytes.data() + bytes.size()) {}

  Mesh mesh;

  /// Returns a complaint, or an empty string.
  std::string read() {
    if (std::string why = read_header(); !why.empty()) return why;
    for (const Element& element : elements_) {
      if (std::string why = read_element(element); !why.empty()) return why;
    }
    if (origin_ && find_unreadable(mesh).empty()) set_origin(mesh, *origin_);
    return {};
  }

 private:
  std::string read_header() {
    cursor_.rest_of_line();  // "ply"
    bool has_format = false;
    while (!cursor_.at_end()) {
      const std::size_t line = cursor_.line();
      const std::string_view word = cursor_.word();
      bool good = true;
      if (word == "end_header") {
        cursor_.rest_of_line();
        at_ = reinterpret_cast<const std::uint8_t*>(cursor_.position());
        return has_format ? "" : "its header names no format";
      } else if (word == "format") {
        const std::string_view format = cursor_.word();
        good = format == "ascii" || format == "binary_little_endian" || format == "binary_big_endian";
        is_text_ = format == "ascii";
        order_ = format == "binary_big_endian" ? std::endian::big : std::endian::little;
        has_format = true;
      } else if (word == "element") {
        std::int64_t count = 0;
        Element element;
        element.name = cursor_.word();
        good = parse_integer(cursor_.word(), count) && count >= 0;
        element.count = static_cast<std::uint64_t>(count);
        elements_.push_back(std::move(element));
      } else if (word == "property") {
        good = read_property();
      } else if (word == "comment") {
        read_comment();
        continue;
      }
      if (!good) return fmt::format("line {} of its header makes no sense", line);
      cursor_.rest_of_line();
    }
    return "its header has no end";
  }

  bool read_property() {
    if (elements_.empty()) return false;
    Property property;
    std::string_view type = cursor_.word();
    const bool is_list = type == "list";
    if (is_list) {
      property.count_type = find_type(cursor_.word());
      if (!property.count_type) return false;
      type = cursor_.word();
    }
    const auto found = find_type(type);
    if (!found) return false;
    property.type = *found;
    Element& element = elements_.back();
    const std::string_view name = cursor_.word();
    if (element.name == "vertex" && !is_list) property.slot = find_slot(name);
    property.is_corners = element.name == "face" && is_list && (name == "vertex_indices" || name == "vertex_index");
    element.properties.push_back(property);
    return true;
  }

  void read_comment() {
    std::string_view text = cursor_.rest_of_line();
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    if (text.starts_with(kPlyOrigin)) {
      origin_ = parse_origin(text.substr(kPlyOrigin.size()));
    } else if (text.starts_with(kPlyKey)) {
      parse_metadata_line(text.substr(kPlyKey.size()), mesh.metadata);
    } else if (text.starts_with(kCrs)) {
      mesh.metadata.emplace("crs", text.substr(kCrs.size()));
    }
  }

  std::size_t remaining() const { return is_text_ ? cursor_.remaining() : static_cast<std::size_t>(end_ - at_); }

  /// The next value of the body. Returns false at the end of the file, or if text is not a number.
  bool read_value(Type type, double& value) {
    if (is_text_) return parse_number(cursor_.word_anywhere(), value);
    const std::size_t size = kTypeSizes[static_cast<int>(type)];
    if (remaining() < size) return false;
    switch (type) {
      case Type::kInt8:
        value = load_number<std::int8_t>(at_, order_);
        break;
      case Type::kUint8:
        value = load_number<std::uint8_t>(at_, order_);
        break;
      case Type::kInt16:
        value = load_number<std::int16_t>(at_, order_);
        break;
      case Type::kUint16:
        value = load_number<std::uint16_t>(at_, order_);
        break;
      case Type::kInt32:
        value = load_number<std::int32_t>(at_, order_);
        break;
      case Type::kUint32:
        value = load_number<std::uint32_t>(at_, order_);
        break;
      case Type::kFloat:
        value = load_number<float>(at_, order_);
        break;
      case Type::kDouble:
        value = load_number<double>(at_, order_);
        break;
    }
    at_ += size;
    return true;
  }

  std::string read_element(const Element& element) {
    if (element.properties.empty()) return {};  // its items have no bytes, whatever their count
    std::size_t least = 0;                      // smallest size of an item; a digit and a space in text
    std::bitset<kSlots> slots;
    for (const Property& property : element.properties) {
      least += is_text_ ? 2 : kTypeSizes[static_cast<int>(property.count_type.value_or(property.type))];
      if (property.slot >= 0) slots.set(static_cast<std::size_t>(property.slot));
    }
    const auto has = [&](int first, int count) {
      while (count > 0 && slots[static_cast<std::size_t>(first + count - 1)]) --count;
      return count == 0;
    };
    const bool is_vertex = element.name == "vertex";
    if (is_vertex && !has(kPosition, 3)) return "its vertices lack x, y or z";
    if (element.count > (remaining() + 1) / least) {
      return fmt::format("it announces {} '{}' items, more than its {} bytes can hold: it was cut off", element.count,
                         element.name, remaining());
    }
    if (is_vertex) {
      mesh.positions.reserve(mesh.positions.size() + 3 * element.count);
      has_normals_ = has(kNormal, 3);
      has_colors_ = has(kColor, 3);
      has_uvs_ = has(kUv, 2);
      mesh.channel_count = static_cast<int>((slots >> kChannel).count());
      if (!has(kChannel, mesh.channel_count)) mesh.channel_count = 0;
    }
    for (std::uint64_t item = 0; item < element.count; ++item) {
      for (const Property& property : element.properties) {
        const bool good = property.count_type ? read_list(property) : read_scalar(property);
        if (!why_no_polygon_.empty()) return why_no_polygon_;
        if (!good) return fmt::format("{} {} (counting from 0) is broken or cut off", element.name, item);
      }
      if (!is_vertex) continue;
      if (const char* what = add_vertex()) {
        return fmt::format("the {} of vertex {} (counting from 0) is not finite", what, item);
      }
    }
    return {};
  }

  /// Adds the vertex in values_. Returns the name of a non-finite value, or null.
  const char* add_vertex() {
    mesh.positions.insert(mesh.positions.end(), &values_[kPosition], &values_[kPosition + 3]);
    for (int k = kNormal; has_normals_ && k < kNormal + 3; ++k) {
      mesh.normals.push_back(to_float(values_[k]));
      if (std::isnan(mesh.normals.back())) return "normal";
    }
    for (int k = kColor; has_colors_ && k < kColor + 3; ++k) mesh.colors.push_back(to_color(values_[k], types_[k]));
    if (has_uvs_) {
      mesh.uvs.push_back(to_float(values_[kUv]));
      mesh.uvs.push_back(to_float(1 - values_[kUv + 1]));  // PLY's images start at the bottom
      if (std::isnan(mesh.uvs.back() + mesh.uvs[mesh.uvs.size() - 2])) return "place in the image";
    }
    for (int k = 0; k < mesh.channel_count; ++k) mesh.channels.push_back(to_float(values_[kChannel + k]));
    return nullptr;
  }

  bool read_scalar(const Property& property) {
    double value = 0;
    if (!read_value(property.type, value)) return false;
    if (property.slot < 0) return true;
    values_[property.slot] = value;
    types_[property.slot] = property.type;
    return true;
  }

  bool read_list(const Property& property) {
    double count = 0;
    if (!read_value(*property.count_type, count)) return false;
    const std::size_t least = is_text_ ? 2 : kTypeSizes[static_cast<int>(property.type)];
    if (!(count >= 0) || count != std::floor(count) || count > static_cast<double>((remaining() + 1) / least))
      return false;
    const bool corners = property.is_corners;
    if (corners && count < 3) return false;
    corners_.clear();
    for (auto left = static_cast<std::size_t>(count); left > 0; --left) {
      double value = 0;
      if (!read_value(property.type, value)) return false;
      if (!corners) continue;
      if (!(value >= 0) || value != std::floor(value) || value > std::numeric_limits<std::uint32_t>::max())
        return false;
      corners_.push_back(static_cast<std::uint32_t>(value));
    }
    if (corners) why_no_polygon_ = append_fan(corners_, mesh.triangles);
    return why_no_polygon_.empty();
  }

  TextCursor cursor_;
  std::string why_no_polygon_;
  const std::uint8_t* at_ = nullptr;  // in the body of a binary file
  const std::uint8_t* end_;
  bool is_text_ = false;
  std::endian order_ = std::endian::little;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> corners_;
  double values_[kSlots] = {};
  Type types_[kSlots] = {};
  bool has_normals_ = false, has_colors_ = false, has_uvs_ = false;
  std::optional<std::array<double, 3>> origin_;
};

/// True if all positions are exact as float32.
bool are_float32(const Mesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (const double coordinate : mesh.vertex(v)) {
      if (!(std::fabs(coordinate) <= double{std::numeric_limits<float>::max()})) return false;
      if (double{static_cast<float>(coordinate)} != coordinate) return false;
    }
  }
  return true;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_ply(const Mesh& mesh, const EncodeOptions& options) {
  const std::size_t vertices = mesh.vertex_count(), triangles = mesh.triangle_count();
  const bool with_normals = !mesh.normals.empty(), with_colors = !mesh.colors.empty(), with_uvs = !mesh.uvs.empty();
  const auto channels = static_cast<std::size_t>(mesh.channel_count);
  const bool as_floats = !options.double_positions && are_float32(mesh);
  std::string header =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment Terrain by Scarp: {}\n", axes_text(mesh));
  if (mesh.origin != std::array<double, 3>{})
    header += fmt::format("comment {}{}\n", kPlyOrigin, origin_text(mesh.origin));
  const auto crs = mesh.metadata.find("crs");
  if (crs != mesh.metadata.end() && crs->second.find_first_of("\r\n") == std::string::npos) {
    header += fmt::format("comment {}{}\n", kCrs, crs->second);
  }
  for (const auto& [key, value] : mesh.metadata) {
    header += fmt::format("comment {}{}\n", kPlyKey, metadata_line(key, value));
  }
  header += fmt::format("element vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n", vertices,
                        as_floats ? "float" : "double");
  if (with_normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (with_colors) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (with_uvs) header += "property float s\nproperty float t\n";
  for (std::size_t c = 0; c < channels; ++c) header += fmt::format("property float channel_{}\n", c + 1);
  header += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", triangles);

  const std::size_t vertex_size =
      (as_floats ? 12 : 24) + (with_normals ? 12 : 0) + (with_colors ? 3 : 0) + (with_uvs ? 8 : 0) + 4 * channels;
  std::vector<std::uint8_t> bytes(header.size() + vertices * vertex_size + triangles * 13);
  std::memcpy(bytes.data(), header.data(), header.size());
  std::uint8_t* at = bytes.data() + header.size();
  for (std::size_t v = 0; v < vertices; ++v) {
    for (const double coordinate : mesh.vertex(v)) {
      if (as_floats) {
        store_number(at, static_cast<float>(coordinate));
      } else {
        store_number(at, coordinate);
      }
    }
    for (std::size_t k = 0; with_normals && k < 3; ++k) store_number(at, mesh.normals[3 * v + k]);
    for (std::size_t k = 0; with_colors && k < 3; ++k) store_number(at, mesh.colors[3 * v + k]);
    if (with_uvs) {
      store_number(at, mesh.uvs[2 * v]);
      store_number(at, static_cast<float>(1 - double{mesh.uvs[2 * v + 1]}));
    }
    for (std::size_t c = 0; c < channels; ++c) store_number(at, mesh.channels[channels * v + c]);
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    store_number(at, std::uint8_t{3});
    for (std::size_t k = 0; k < 3; ++k) store_number(at, mesh.triangles[3 * t + k]);
  }
  return bytes;
}

Result<Mesh> decode_ply(std::span<const std::uint8_t> bytes) {
  PlyReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
