// Common parts of the LandXML readers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/mesh/xml_reader.h"
#include "io/raster/height_unit.h"
#include "scarp/lines.h"
#include "scarp/result.h"

namespace scarp::io {

/// The unit and the CRS of a file.
struct LandXmlHead {
  std::string linear_unit, elevation_unit, crs;

  /// Reads the element if it belongs to the head.
  void read(const XmlReader& xml);
  /// The unit of x and y.
  HeightUnit unit() const;
  HeightUnit height_unit() const;
  /// False if this build does not know the CRS.
  bool has_crs() const;
  /// Fails if the CRS has another unit.
  Result<void> check(const std::string& path) const;
};

/// A warning that this build does not know the CRS.
std::string warn_of_unknown_crs(const LandXmlHead& head, const std::string& path);

/// The complaint with the line of the file; empty for an empty complaint.
std::string at_line(const XmlReader& xml, const std::string& why);

/// Replaces `numbers` by the numbers in the text. Returns a complaint, or an empty string.
std::string read_numbers(const std::string& text, std::vector<double>& numbers);

enum class BoundaryKind { kOuter, kVoid, kIsland };

/// The kind by its name in a file: outer, void (also by other programs' names for it), island. Nothing for other names.
std::optional<BoundaryKind> find_boundary_kind(const std::string& name);

struct LandXmlBoundary {
  std::string surface;
  BoundaryKind kind = BoundaryKind::kOuter;
  Line ring;  ///< without heights
};

struct LandXmlBoundaries {
  LandXmlHead head;
  std::vector<LandXmlBoundary> rings;
  std::uint64_t without_extent = 0;  ///< number of omitted rings
  bool has_breaklines = false;
};

/// The boundaries of all surfaces, in the order of the file. Fails with kInput and the line if the file cannot be read,
/// or a boundary has another kind or no points.
Result<LandXmlBoundaries> read_landxml_boundaries(std::span<const std::uint8_t> bytes, const std::string& path);

/// True for a LandXML file, by its first bytes.
bool is_landxml(const std::string& path);

}  // namespace scarp::io
