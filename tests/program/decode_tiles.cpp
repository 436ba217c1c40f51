// Decodes the tiles of a folder with the library into a stream in the format of tests/js/read_quantized_mesh.mjs:
// decode_tiles FOLDER > OUTPUT
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/gzip.h"
#include "scarp/tile.h"

namespace {

template <class T, class List>
void put(const List& list) {
  const std::vector<T> values(list.begin(), list.end());
  std::fwrite(values.data(), sizeof(T), values.size(), stdout);
}

template <class T, class List>
void put_counted(const List& list) {
  put<std::uint32_t>(std::vector{list.size()});
  put<T>(list);
}

void put_tile(const scarp::QuantizedMesh& mesh) {
  put<double>(mesh.center);
  put<double>(std::vector{mesh.min_height, mesh.max_height});
  put<double>(mesh.sphere);
  put<double>(mesh.horizon_point);
  std::vector<std::uint16_t> vertices = mesh.u;
  vertices.insert(vertices.end(), mesh.v.begin(), mesh.v.end());
  vertices.insert(vertices.end(), mesh.h.begin(), mesh.h.end());
  put_counted<std::uint16_t>(vertices);
  put_counted<std::uint32_t>(mesh.triangles);
  for (const auto* edge : {&mesh.west, &mesh.south, &mesh.east, &mesh.north}) put_counted<std::uint32_t>(*edge);
  std::vector<std::uint8_t> normals;
  for (const auto& normal : mesh.normals) normals.insert(normals.end(), normal.begin(), normal.end());
  put_counted<std::uint8_t>(normals);
  put_counted<std::uint8_t>(mesh.water_mask);
}

int complain(const scarp::Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[1])) {
    if (entry.path().extension() == ".terrain") names.push_back(entry.path().lexically_relative(argv[1]).string());
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    std::ifstream file(std::filesystem::path(argv[1]) / name, std::ios::binary);
    const std::vector<std::uint8_t> packed{std::istreambuf_iterator<char>(file), {}};
    const auto bytes = scarp::io::decompress_gzip(packed, 1 << 28);
    if (!bytes) return complain(bytes.error());
    const auto mesh = scarp::decode_quantized_mesh(*bytes, name);
    if (!mesh) return complain(mesh.error());
    std::printf("%s\n", name.c_str());
    put_tile(*mesh);
  }
}
