// The arrays of a possibly hostile GLB file: accessors, views, and compressed views.
//
// Verifies every index against the array it refers to, every accessor against its view, and every view against the
// binary chunk or a decoded stream.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/glb_json.h"

namespace scarp::io {

/// A checked accessor: `count` items of one or more components, `stride` bytes apart.
struct GlbItems {
  const std::uint8_t* data = nullptr;
  std::uint64_t count = 0, stride = 0;
  int component_type = 0;
  bool is_normalized = false;  ///< integers represent fractions of their type's maximum

  std::uint64_t component_size() const;
  /// Component k of item i.
  double number(std::uint64_t i, std::uint64_t k) const;
  /// REQUIRES: unsigned integers.
  std::uint64_t index(std::uint64_t i) const;
};

/// Bytes of a component; 0 for a type unknown to glTF.
std::uint64_t size_of_component(std::uint64_t component_type);

class GlbArrays {
 public:
  std::string complaint;  ///< the first complaint

 protected:
  bool refuse(std::string why);
  static const Json* member(const Json& object, const char* key);
  /// True for a primitive declared as a skirt below a tile's edges, which is not part of the surface.
  static bool is_skirt(const Json& primitive);
  /// The non-negative integer `key` of `object`, or `missing` if absent.
  bool read_count(const Json& object, const char* key, std::uint64_t missing, std::uint64_t& value);
  /// Item `index` of the top-level array `array`.
  const Json* item(const char* array, std::uint64_t index);
  /// The items of an accessor of a type such as "VEC3".
  bool find_items(std::uint64_t accessor, std::string_view type, GlbItems& items);

  /// The bytes of a view, and its stride; 0 if not given.
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

}  // namespace scarp::io
