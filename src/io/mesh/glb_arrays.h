// The arrays of a GLB file that may be hostile: accessors, views, and views that are compressed.
//
// Nothing in the file is believed: every index is checked against the array it names, every accessor against its view,
// every view against the binary chunk or what a stream decodes to.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/glb_json.h"

namespace scarp {

/// A checked accessor: `count` items of one or more components, `stride` bytes apart.
struct GlbItems {
  const std::uint8_t* data = nullptr;
  std::uint64_t count = 0, stride = 0;
  int component_type = 0;
  bool is_normalized = false;  ///< integers stand for fractions of their largest value

  std::uint64_t component_size() const;
  /// Component k of item i.
  double number(std::uint64_t i, std::uint64_t k) const;
  /// REQUIRES: unsigned integers.
  std::uint64_t index(std::uint64_t i) const;
};

/// 0 for a type that is none of glTF's.
std::uint64_t size_of_component(std::uint64_t component_type);

class GlbArrays {
 public:
  std::string complaint;  ///< the first

 protected:
  bool refuse(std::string why);
  static const Json* member(const Json& object, const char* key);
  /// True if a primitive is declared to hang from a tile's edges, and is no part of the surface.
  static bool is_skirt(const Json& primitive);
  /// The non-negative integer `key` of `object`, or `missing` where there is none.
  bool read_count(const Json& object, const char* key, std::uint64_t missing, std::uint64_t& value);
  /// Item `index` of the top-level array `array`.
  const Json* item(const char* array, std::uint64_t index);
  /// The items of an accessor of the type, such as "VEC3".
  bool find_items(std::uint64_t accessor, std::string_view type, GlbItems& items);

  /// Bytes, and the stride that the view gives; 0 where it gives none.
  struct View {
    std::span<const std::uint8_t> bytes;
    std::uint64_t stride = 0;
  };
  bool find_view(std::uint64_t index, View& view);

  std::span<const std::uint8_t> binary_;
  Json json_;

 private:
  bool find_bytes(const Json& object, const std::string& name, std::span<const std::uint8_t>& bytes);
  bool decode_view(std::uint64_t index, const Json& packed, View& view);

  std::map<std::uint64_t, std::vector<std::uint8_t>> decoded_;  // by view
};

}  // namespace scarp
