// A mesh as bytes for another process of the caller: all data of a scarp_mesh, by one list of its members.
#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>

#include "door.h"
#include "mesh.h"
#include "scarp/version.h"

namespace scarp::door {
namespace {

class Packer {
 public:
  explicit Packer(std::vector<std::uint8_t>& out) : out_(out) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const T& value) { add(&value, sizeof value); }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    add(values.data(), values.size() * sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(std::uint64_t{text.size()});
    add(text.data(), text.size());
  }
  void operator()(const std::optional<std::string>& text) {
    (*this)(text.has_value());
    (*this)(text.value_or(""));
  }
  void operator()(const std::map<std::string, std::string>& texts) {
    (*this)(std::uint64_t{texts.size()});
    for (const auto& [key, value] : texts) (*this)(key), (*this)(value);
  }

 private:
  void add(const void* bytes, std::size_t count) {
    const auto* const first = static_cast<const std::uint8_t*>(bytes);
    out_.insert(out_.end(), first, first + count);
  }
  std::vector<std::uint8_t>& out_;
};

class Unpacker {
 public:
  Unpacker(const std::uint8_t* bytes, std::uint64_t count) : bytes_(bytes), left_(count) {}
  bool is_done() const { return left_ == 0; }

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { take(&value, 1, sizeof value); }
  template <class T>
  void operator()(std::vector<T>& values) {
    values.resize(count_of(sizeof(T)));
    take(values.data(), values.size(), sizeof(T));
  }
  void operator()(std::string& text) {
    text.resize(count_of(1));
    take(text.data(), text.size(), 1);
  }
  void operator()(std::optional<std::string>& text) {
    bool has_text = false;
    (*this)(has_text);
    (*this)(text.emplace());
    if (!has_text) text.reset();
  }
  void operator()(std::map<std::string, std::string>& texts) {
    for (std::uint64_t left = count_of(1); left > 0; --left) {
      std::string key;
      (*this)(key);
      (*this)(texts[key]);
    }
  }

 private:
  std::size_t count_of(std::size_t size) {
    std::uint64_t count = 0;
    (*this)(count);
    check(count <= left_ / size);
    return count;
  }
  void take(void* to, std::size_t count, std::size_t size) {
    check(count * size <= left_);
    if (count > 0) std::memcpy(to, bytes_, count * size);
    bytes_ += count * size;
    left_ -= count * size;
  }
  static void check(bool holds) {
    if (!holds) throw Refused{{ErrorKind::kInput, "the bytes of the mesh end too soon"}};
  }
  const std::uint8_t* bytes_;
  std::uint64_t left_;
};

template <class Archive, class Packed>
void visit_members(Archive& archive, Packed& mesh) {
  auto& plain = mesh.mesh;
  archive(plain.origin);
  archive(plain.positions);
  archive(plain.triangles);
  archive(plain.normals);
  archive(plain.uvs);
  archive(plain.colors);
  archive(plain.channel_count);
  archive(plain.channels);
  archive(plain.metadata);
  archive(mesh.report);
  archive(mesh.format);
  archive(mesh.up);
  archive(mesh.crs);
  archive(mesh.is_print);
  archive(mesh.doubles);
  archive(mesh.glb.compress);
  archive(mesh.glb.cell);
  for (auto* image : {&mesh.glb.base_color, &mesh.glb.normal_map}) {
    archive(image->bytes);
    archive(image->mime_type);
  }
  archive(mesh.glb.threads);
  archive(mesh.warnings);
}

/// The mark of a version: bytes of another version may contain other members.
std::string mark() { return std::string("Scarp's mesh, version ") + version(); }

bool has_lost_corner(const Mesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](std::uint32_t corner) { return corner >= mesh.vertex_count(); });
}

}  // namespace
}  // namespace scarp::door

using namespace scarp::door;
using scarp::ErrorKind;

extern "C" {

scarp_status scarp_mesh_pack(const scarp_mesh* mesh, scarp_bytes** out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr)
      return report(ErrorKind::kUsage, "the mesh, or the place for its bytes, is a null pointer");
    *out = nullptr;
    auto bytes = std::make_unique<scarp_bytes>();
    Packer pack(bytes->bytes);
    pack(mark());
    visit_members(pack, *mesh);
    *out = bytes.release();
    return SCARP_OK;
  });
}

scarp_status scarp_mesh_unpack(const uint8_t* bytes, uint64_t size, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (bytes == nullptr || out == nullptr)
      return report(ErrorKind::kUsage, "the bytes, or the place for the mesh, are a null pointer");
    *out = nullptr;
    Unpacker unpack(bytes, size);
    std::string marked;
    unpack(marked);
    if (marked != mark())
      return report(ErrorKind::kInput, "the bytes are not of a mesh that this version of Scarp packed");
    auto mesh = std::make_unique<scarp_mesh>();
    visit_members(unpack, *mesh);
    if (!unpack.is_done() || has_lost_corner(mesh->mesh))
      return report(ErrorKind::kInput, "the bytes of the mesh are damaged");
    *out = mesh.release();
    return SCARP_OK;
  });
}

}  // extern "C"
