// DXF of AutoCAD's release 12, which every CAD program reads. It consists of pairs of lines: a group number and a
// value. A triangle is a 3DFACE whose fourth corner repeats the third. Corners are only positions, and are welded on
// reading.
//
// Lines of group 999 are comments. They hold the mesh's metadata, split into lines of at most 255 bytes, the limit of
// release 12.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/welder.h"

namespace scarp::io {
namespace {

constexpr std::string_view kDxfOrigin = "scarp.origin: ", kDxfKey = "scarp ", kDxfMore = "scarp+ ";

void append_comment(const std::string& text, std::string& lines) {
  constexpr std::size_t kMost = 240;
  lines += fmt::format("999\n{}\n", std::string_view(text).substr(0, kMost));
  for (std::size_t at = kMost; at < text.size(); at += kMost) {
    lines += fmt::format("999\n{}{}\n", kDxfMore, std::string_view(text).substr(at, kMost));
  }
}

/// The largest or smallest corner of the mesh's bounding box.
std::array<double, 3> corner_of_box(const Mesh& mesh, bool largest) {
  std::array<double, 3> corner = mesh.vertex(mesh.triangles[0]);
  for (const std::uint32_t v : mesh.triangles) {
    const auto p = mesh.vertex(v);
    for (std::size_t k = 0; k < 3; ++k) corner[k] = largest ? std::fmax(corner[k], p[k]) : std::fmin(corner[k], p[k]);
  }
  return corner;
}

class DxfReader {
 public:
  explicit DxfReader(std::span<const std::uint8_t> bytes) : cursor_(bytes) {}

  Mesh mesh;

  std::string read() {
    while (!cursor_.at_end() && !has_ended_) {
      const std::size_t line = cursor_.line();
      std::int64_t group = 0;
      if (!parse_integer(trim(cursor_.rest_of_line()), group)) return fmt::format("line {}: no group's number", line);
      if (cursor_.at_end()) return "it ends within a group: it was cut off";
      std::string why = read_group(group, cursor_.rest_of_line());
      if (!why.empty()) return fmt::format("line {}: {}", line + 1, why);
    }
    if (!has_ended_) return "it has no end mark: it was cut off";
    take_comment();
    weld();
    if (origin_ && find_unreadable(mesh).empty()) set_origin(mesh, *origin_);
    return {};
  }

 private:
  static std::string_view trim(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
  }

  std::string read_group(std::int64_t group, std::string_view text) {
    if (group == 999) {
      read_comment(text);
      return {};
    }
    if (group == 0) return begin_entity(trim(text));
    if (group == 2 && begins_section_) {
      in_entities_ = trim(text) == "ENTITIES";
      begins_section_ = false;
    }
    const std::int64_t axis = group / 10 - 1, corner = group % 10;
    if (!in_face_ || group < 10 || group > 39 || corner > 3) return {};
    double value = 0;
    if (!parse_number(trim(text), value) || !std::isfinite(value)) return "a coordinate is no finite number";
    corners_[static_cast<std::size_t>(corner)][static_cast<std::size_t>(axis)] = value;
    seen_ |= 1u << (corner * 3 + axis);
    return {};
  }

  std::string begin_entity(std::string_view kind) {
    std::string why = end_face();
    begins_section_ = kind == "SECTION";
    if (kind == "ENDSEC") in_entities_ = false;
    has_ended_ = kind == "EOF";
    in_face_ = in_entities_ && kind == "3DFACE";
    seen_ = 0;
    return why;
  }

  std::string end_face() {
    if (!in_face_) return {};
    constexpr unsigned kPlan = 0b011'011'011, kFourth = 0b011'000'000'000;
    if ((seen_ & kPlan) != kPlan) return "a 3DFACE ends without its three corners";
    for (std::size_t k = 0; k < 4; ++k) {
      if ((seen_ >> (3 * k + 2) & 1) == 0) corners_[k][2] = 0;  // a flat face omits its heights
    }
    add_triangle(0, 1, 2);
    if ((seen_ & kFourth) == kFourth && corners_[3] != corners_[2]) add_triangle(0, 2, 3);
    return {};
  }

  void add_triangle(std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t k : {a, b, c}) places_.insert(places_.end(), corners_[k].begin(), corners_[k].end());
  }

  void read_comment(std::string_view text) {
    if (text.starts_with(kDxfMore)) {
      comment_ += text.substr(kDxfMore.size());
      return;
    }
    take_comment();
    comment_ = text;
  }

  void take_comment() {
    const std::string_view text = comment_;
    if (text.starts_with(kDxfOrigin)) {
      origin_ = parse_origin(text.substr(kDxfOrigin.size()));
    } else if (text.starts_with(kDxfKey)) {
      parse_metadata_line(text.substr(kDxfKey.size()), mesh.metadata);
    }
  }

  void weld() {
    Welder welder(mesh.positions, places_.size() / 3);
    mesh.triangles.reserve(places_.size() / 3);
    for (std::size_t i = 0; i < places_.size(); i += 3) {
      mesh.triangles.push_back(welder.find_or_add(places_[i], places_[i + 1], places_[i + 2]));
    }
  }

  TextCursor cursor_;
  bool begins_section_ = false, in_entities_ = false, in_face_ = false, has_ended_ = false;
  std::array<std::array<double, 3>, 4> corners_{};  // corners of the current face
  unsigned seen_ = 0;                               // coordinates read so far, three bits per corner
  std::vector<double> places_;
  std::string comment_;  // current comment so far
  std::optional<std::array<double, 3>> origin_;
};

}  // namespace

bool is_dxf(std::span<const std::uint8_t> bytes) {
  TextCursor cursor(bytes);
  const std::string_view group = cursor.word();
  cursor.rest_of_line();
  return group == "999" || (group == "0" && cursor.word() == "SECTION");
}

Result<std::vector<std::uint8_t>> encode_dxf(const Mesh& mesh) {
  std::string header;
  append_comment("Terrain by Scarp: x east, y north, z up; faces counter-clockwise from above", header);
  if (mesh.origin != std::array<double, 3>{})
    append_comment(fmt::format("{}{}", kDxfOrigin, origin_text(mesh.origin)), header);
  for (const auto& [key, value] : mesh.metadata) {
    append_comment(fmt::format("{}{}", kDxfKey, ascii_metadata_line(key, value)), header);
  }
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  bytes.reserve(header.size() + mesh.triangles.size() * 64);
  auto out = std::back_inserter(bytes);
  fmt::format_to(out, "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n");
  for (const bool largest : {false, true}) {
    const auto p = corner_of_box(mesh, largest);
    fmt::format_to(out, "9\n{}\n10\n{:#}\n20\n{:#}\n30\n{:#}\n", largest ? "$EXTMAX" : "$EXTMIN", p[0], p[1], p[2]);
  }
  fmt::format_to(out, "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    fmt::format_to(out, "0\n3DFACE\n8\nTERRAIN\n");
    for (std::size_t k = 0; k < 4; ++k) {
      const auto p = mesh.vertex(mesh.triangles[i + std::min<std::size_t>(k, 2)]);
      fmt::format_to(out, "1{}\n{:#}\n2{}\n{:#}\n3{}\n{:#}\n", k, p[0], k, p[1], k, p[2]);
    }
  }
  fmt::format_to(out, "0\nENDSEC\n0\nEOF\n");
  return bytes;
}

Result<Mesh> decode_dxf(std::span<const std::uint8_t> bytes) {
  DxfReader reader(bytes);
  if (std::string why = reader.read(); !why.empty()) return fail(ErrorKind::kInput, std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io
