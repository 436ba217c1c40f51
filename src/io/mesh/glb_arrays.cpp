#include "io/mesh/glb_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_numbers.h"
#include "io/mesh/meshopt_codec.h"

namespace scarp::io {
namespace {

template <class T>
double load_component(const std::uint8_t* at, bool is_normalized, double largest) {
  const auto number = static_cast<double>(load_number<T>(at));
  return is_normalized ? std::max(number / largest, -1.0) : number;
}

/// The index of the word among the choices; -1 for other values.
int find_word(const Json* word, std::initializer_list<std::string_view> choices) {
  if (word == nullptr || !word->is_string()) return -1;
  const auto found = std::find(choices.begin(), choices.end(), word->get_ref<const std::string&>());
  return found == choices.end() ? -1 : static_cast<int>(found - choices.begin());
}

}  // namespace

std::uint64_t size_of_component(std::uint64_t component_type) {
  switch (component_type) {
    case kInt8Component:
    case kUint8Component:
      return 1;
    case kInt16Component:
    case kUint16Component:
      return 2;
    case kUint32Component:
    case kFloatComponent:
      return 4;
    default:
      return 0;
  }
}

std::uint64_t GlbItems::component_size() const { return size_of_component(static_cast<std::uint64_t>(component_type)); }

double GlbItems::number(std::uint64_t i, std::uint64_t k) const {
  const std::uint8_t* at = data + i * stride + k * component_size();
  switch (component_type) {
    case kInt8Component:
      return load_component<std::int8_t>(at, is_normalized, 127);
    case kUint8Component:
      return load_component<std::uint8_t>(at, is_normalized, 255);
    case kInt16Component:
      return load_component<std::int16_t>(at, is_normalized, 32767);
    case kUint16Component:
      return load_component<std::uint16_t>(at, is_normalized, 65535);
    case kUint32Component:
      return load_number<std::uint32_t>(at);
    default:
      return load_number<float>(at);
  }
}

std::uint64_t GlbItems::index(std::uint64_t i) const {
  const std::uint8_t* at = data + i * stride;
  if (component_type == kUint8Component) return *at;
  return component_type == kUint16Component ? load_number<std::uint16_t>(at) : load_number<std::uint32_t>(at);
}

bool GlbArrays::refuse(std::string why) {
  if (complaint.empty()) complaint = std::move(why);
  return false;
}

const Json* GlbArrays::member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

bool GlbArrays::is_skirt(const Json& primitive) {
  const Json* at = &primitive;
  for (const char* key : {"extras", "scarp", "skirt"}) {
    if (at = member(*at, key); at == nullptr) return false;
  }
  return at->is_boolean() && at->get<bool>();
}

bool GlbArrays::read_count(const Json& object, const char* key, std::uint64_t missing, std::uint64_t& value) {
  const Json* found = member(object, key);
  value = missing;
  if (!found) return true;
  if (!found->is_number_unsigned()) return refuse(fmt::format("a '{}' in its JSON is not a count", key));
  value = found->get<std::uint64_t>();
  return true;
}

const Json* GlbArrays::item(const char* array, std::uint64_t index) {
  const Json* items = member(json_, array);
  if (items && items->is_array() && index < items->size()) return &(*items)[index];
  refuse(fmt::format("its JSON refers to {} {}, which does not exist", array, index));
  return nullptr;
}

bool GlbArrays::find_items(std::uint64_t index, std::string_view type, GlbItems& items) {
  const Json* accessor = item("accessors", index);
  if (!accessor) return false;
  const auto broken = [&](std::string_view what) { return refuse(fmt::format("its accessor {} {}", index, what)); };
  if (member(*accessor, "sparse")) return broken("is sparse, which is not supported");
  if (!member(*accessor, "bufferView")) return broken("has no buffer view");
  const Json* given_type = member(*accessor, "type");
  if (!given_type || !given_type->is_string() || given_type->get_ref<const std::string&>() != type) {
    return broken(fmt::format("is not of type {}", type));
  }
  std::uint64_t component_type = 0, offset = 0, view_index = 0;
  if (!read_count(*accessor, "componentType", 0, component_type) || !read_count(*accessor, "count", 0, items.count) ||
      !read_count(*accessor, "byteOffset", 0, offset) || !read_count(*accessor, "bufferView", 0, view_index)) {
    return false;
  }
  std::uint64_t size = size_of_component(component_type);
  if (size == 0) return broken(fmt::format("has component type {}, which is not supported here", component_type));
  items.component_type = static_cast<int>(component_type);
  const Json* normalized = member(*accessor, "normalized");
  items.is_normalized = normalized != nullptr && *normalized == true;
  size *= type == "SCALAR" ? 1 : static_cast<std::uint64_t>(type.back() - '0');

  View view;
  if (!find_view(view_index, view)) return false;
  items.stride = view.stride > 0 ? view.stride : size;
  const std::uint64_t length = view.bytes.size();
  if (items.stride < size || items.stride > 252 + size) return broken("has an impossible stride");
  if (items.count == 0) return broken("is empty");
  if (offset > length || length - offset < size || items.count - 1 > (length - offset - size) / items.stride) {
    return broken("reaches beyond its buffer view");
  }
  items.data = view.bytes.data() + offset;
  return true;
}

bool GlbArrays::find_view(std::uint64_t index, View& view) {
  const Json* described = item("bufferViews", index);
  if (!described) return false;
  if (!read_count(*described, "byteStride", 0, view.stride)) return false;
  const Json* extensions = member(*described, "extensions");
  if (const Json* packed = extensions ? member(*extensions, "EXT_meshopt_compression") : nullptr) {
    return decode_view(index, *packed, view);
  }
  return find_bytes(*described, fmt::format("buffer view {}", index), view.bytes);
}

bool GlbArrays::find_bytes(const Json& object, const std::string& name, std::span<const std::uint8_t>& bytes) {
  std::uint64_t buffer = 0, start = 0, length = 0;
  if (!read_count(object, "buffer", 0, buffer) || !read_count(object, "byteOffset", 0, start) ||
      !read_count(object, "byteLength", 0, length)) {
    return false;
  }
  const Json* buffer_json = item("buffers", buffer);
  if (!buffer_json) return false;
  if (buffer != 0 || member(*buffer_json, "uri"))
    return refuse(fmt::format("its {} keeps its data outside of the file's binary chunk", name));
  if (start > binary_.size() || length > binary_.size() - start)
    return refuse(fmt::format("its {} reaches beyond the binary chunk", name));
  bytes = binary_.subspan(start, length);
  return true;
}

bool GlbArrays::decode_view(std::uint64_t index, const Json& packed, View& view) {
  const std::string name = fmt::format("compressed buffer view {}", index);
  MeshoptStream stream;
  if (!find_bytes(packed, name, stream.bytes) || !read_count(packed, "count", 0, stream.count) ||
      !read_count(packed, "byteStride", 0, stream.stride)) {
    return false;
  }
  const int mode = find_word(member(packed, "mode"), {"ATTRIBUTES", "TRIANGLES", "INDICES"});
  const Json* named = member(packed, "filter");
  const int filter = named ? find_word(named, {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}) : 0;
  if (mode < 0) return refuse(fmt::format("its {} has a mode that is not supported", name));
  if (filter < 0) return refuse(fmt::format("its {} has a filter that is not supported", name));
  stream.mode = static_cast<MeshoptMode>(mode);
  stream.filter = static_cast<MeshoptFilter>(filter);
  auto [known, is_new] = decoded_.try_emplace(index);
  if (is_new) {
    if (const char* why = decode_meshopt(stream, known->second)) return refuse(fmt::format("its {} {}", name, why));
  }
  view.bytes = known->second;
  if (view.stride == 0 && stream.mode == MeshoptMode::kAttributes) view.stride = stream.stride;
  return true;
}

}  // namespace scarp::io
