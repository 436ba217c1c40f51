// STL: triangles without shared vertices. Writes binary files; reads binary and text.
//
// The format has three float32 per corner and no origin. So offsets are written, and the origin is stored in the
// 80-byte header, which begins with "scarp" (readers would read a header that begins with "solid" as text). If the mesh
// has a solid's placement, that is stored instead, as text or, if too long, as six doubles. On reading, corners at
// exactly equal positions become one vertex, which restores the topology.

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/mesh/file_bytes.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/welder.h"

namespace scarp::io {
namespace {

constexpr std::size_t kHeaderSize = 80, kTriangleSize = 50;
constexpr std::string_view kOriginDecimal = "scarp origin ", kOriginBits = "scarp origin bits ",
                           kPlaced = "scarp placed ", kPlacedBytes = "scarp placed\1", kYUp = " up y";
constexpr const char* kPlacementKey = "placement";

std::string placement_header(const std::string& placement) {
  if (kPlaced.size() + placement.size() + kYUp.size() < kHeaderSize) return fmt::format("{}{}", kPlaced, placement);
  std::vector<std::uint8_t> bytes(48);
  std::uint8_t* at = bytes.data();
  TextCursor cursor({reinterpret_cast<const std::uint8_t*>(placement.data()), placement.size()});
  for (int k = 0; k < 6; ++k) {
    double number = 0;
    if (!cursor.number(number)) return {};
    store_number(at, number);
  }
  return std::string(kPlacedBytes) + std::string(bytes.begin(), bytes.end());
}

/// The text after placement_header()'s words; nothing if absent.
std::optional<std::string> parse_placement(std::string_view header) {
  if (header.starts_with(kPlaced)) {
    header.remove_prefix(kPlaced.size());
    return std::string(header.substr(0, header.find('\0')));
  }
  if (!header.starts_with(kPlacedBytes)) return std::nullopt;
  const auto* at = reinterpret_cast<const std::uint8_t*>(header.data()) + kPlacedBytes.size();
  std::string text;
  for (std::size_t k = 0; k < 6; ++k) text += fmt::format("{}{}", k == 0 ? "" : " ", load_number<double>(at + 8 * k));
  return text;
}

/// Decimal text if it fits the header, which is nearly always true; else the bits of the three doubles.
std::string place_text(const Mesh& mesh) {
  const std::array<double, 3>& origin = mesh.origin;
  if (const auto placed = mesh.metadata.find(kPlacementKey); placed != mesh.metadata.end()) {
    if (std::string text = placement_header(placed->second); !text.empty()) return text;
  }
  std::string text = fmt::format("{}{}", kOriginDecimal, origin_text(origin));
  if (text.size() + kYUp.size() < kHeaderSize) return text;
  return fmt::format("{}{:016x}{:016x}{:016x}", kOriginBits, std::bit_cast<std::uint64_t>(origin[0]),
                     std::bit_cast<std::uint64_t>(origin[1]), std::bit_cast<std::uint64_t>(origin[2]));
}

std::string header_text(const Mesh& mesh) { return place_text(mesh) + (is_y_up(mesh) ? std::string(kYUp) : ""); }

/// Removes the suffix and returns true, if present.
bool take_y_up(std::string_view& header) {
  header = header.substr(0, header.find_last_not_of('\0') + 1);
  if (!header.starts_with("scarp ") || !header.ends_with(kYUp)) return false;
  header.remove_suffix(kYUp.size());
  return true;
}

std::optional<std::array<double, 3>> parse_header(std::string_view header) {
  header = header.substr(0, header.find('\0'));
  if (!header.starts_with(kOriginBits)) {
    return header.starts_with(kOriginDecimal) ? parse_origin(header.substr(kOriginDecimal.size())) : std::nullopt;
  }
  header.remove_prefix(kOriginBits.size());
  if (header.size() != 48) return {};
  std::array<double, 3> origin{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint64_t bits = 0;
    for (const char c : header.substr(16 * k, 16)) {
      const bool letter = c >= 'a' && c <= 'f';
      if (!letter && !(c >= '0' && c <= '9')) return {};
      bits = bits * 16 + static_cast<std::uint64_t>(letter ? c - 'a' + 10 : c - '0');
    }
    origin[k] = std::bit_cast<double>(bits);
    if (!std::isfinite(origin[k])) return {};
  }
  return origin;
}

Result<Mesh> decode_binary(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderSize + 4) {
    return fail(ErrorKind::kInput,
                fmt::format("it ends after {} bytes, within the header of an STL file", bytes.size()));
  }
  const std::uint64_t count = load_number<std::uint32_t>(&bytes[kHeaderSize]);
  const std::uint64_t whole = (bytes.size() - kHeaderSize - 4) / kTriangleSize;
  if (whole < count) {
    return fail(ErrorKind::kInput, fmt::format("it ends after {} of {} triangles: it was cut off", whole, count));
  }
  if (3 * count > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorKind::kInput, fmt::format("its {} triangles are too many for 32-bit corners", count));
  }
  Mesh mesh;
  mesh.triangles.reserve(3 * count);
  Welder welder(mesh.positions, 3 * count);
  for (std::uint64_t t = 0; t < count; ++t) {
    const std::uint8_t* at = &bytes[kHeaderSize + 4 + kTriangleSize * t + 12];
    for (int corner = 0; corner < 3; ++corner, at += 12) {
      const double x = load_number<float>(at), y = load_number<float>(at + 4), z = load_number<float>(at + 8);
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
        return fail(ErrorKind::kInput, fmt::format("triangle {} (counting from 0) has a corner that is not finite", t));
      }
      mesh.triangles.push_back(welder.find_or_add(x, y, z));
    }
  }
  std::string_view header(reinterpret_cast<const char*>(bytes.data()), kHeaderSize);
  if (take_y_up(header)) mesh.metadata["up"] = "y";
  if (const auto origin = parse_header(header)) mesh.origin = *origin;
  if (auto placement = parse_placement(header)) mesh.metadata[kPlacementKey] = std::move(*placement);
  return mesh;
}

bool is_word(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (c != lower[i]) return false;
  }
  return true;
}

Result<Mesh> decode_text(std::span<const std::uint8_t> bytes) {
  Mesh mesh;
  std::vector<double> corners;
  TextCursor cursor(bytes);
  bool open = false;
  const auto wrong = [](std::size_t line, std::string_view what) {
    return fail(ErrorKind::kInput, fmt::format("line {}: {}", line, what));
  };
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view word = cursor.word();
    if (is_word(word, "vertex")) {
      for (int k = 0; k < 3; ++k) {
        double value = 0;
        if (!cursor.number(value) || !std::isfinite(value)) return wrong(line, "a vertex needs three finite numbers");
        corners.push_back(value);
      }
    } else if (is_word(word, "endloop") && corners.size() % 9 != 0) {
      return wrong(line, "a loop that is not a triangle ends here");
    } else if (is_word(word, "solid")) {
      open = true;
    } else if (is_word(word, "endsolid")) {
      open = false;
    }
    cursor.rest_of_line();
  }
  if (open) return wrong(cursor.line(), "the text ends without 'endsolid': it was cut off");
  if (corners.size() % 9 != 0) return wrong(cursor.line(), "the last triangle lacks a corner");
  Welder welder(mesh.positions, corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    mesh.triangles.push_back(welder.find_or_add(corners[i], corners[i + 1], corners[i + 2]));
  }
  return mesh;
}

}  // namespace

bool is_binary_stl(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kHeaderSize + 4 &&
         bytes.size() == kHeaderSize + 4 + kTriangleSize * std::size_t{load_number<std::uint32_t>(&bytes[kHeaderSize])};
}

Result<std::vector<std::uint8_t>> encode_stl(const Mesh& mesh) {
  const std::size_t count = mesh.triangle_count();
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorKind::kOutput, fmt::format("an STL file holds at most {} triangles, and these are {}; write PLY",
                                                std::numeric_limits<std::uint32_t>::max(), count));
  }
  std::vector<std::uint8_t> bytes(kHeaderSize + 4 + kTriangleSize * count);
  const std::string header = header_text(mesh);
  std::memcpy(bytes.data(), header.data(), header.size());
  std::uint8_t* at = bytes.data() + kHeaderSize;
  store_number(at, static_cast<std::uint32_t>(count));
  for (std::size_t t = 0; t < count; ++t) {
    float p[3][3];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t k = 0; k < 3; ++k) {
        p[corner][k] = static_cast<float>(mesh.positions[3 * std::size_t{mesh.triangles[3 * t + corner]} + k]);
      }
    }
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      u[k] = double{p[1][k]} - double{p[0][k]};
      v[k] = double{p[2][k]} - double{p[0][k]};
    }
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (const double component : n) {
      store_number(at, length > 0 && std::isfinite(length) ? static_cast<float>(component / length) : 0.0f);
    }
    for (const auto& corner : p) {
      for (const float coordinate : corner) store_number(at, coordinate);
    }
    store_number(at, std::uint16_t{0});
  }
  return bytes;
}

Result<Mesh> decode_stl(std::span<const std::uint8_t> bytes) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 5));
  return !is_binary_stl(bytes) && start == "solid" ? decode_text(bytes) : decode_binary(bytes);
}

}  // namespace scarp::io
