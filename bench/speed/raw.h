// Raw rasters, and meshes as files for the judge: inputs and outputs of timed programs and peers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "../harness.h"

namespace bench {

/// Native-endian float32 samples without a header, row by row.
struct RawRaster {
  std::vector<float> samples;
  int cols = 0, rows = 0;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

inline File open_file(const std::string& path, const char* mode) {
  File file(std::fopen(path.c_str(), mode), &std::fclose);
  if (!file) die("cannot open " + path);
  return file;
}

/// The raster given by the first three arguments, RASTER COLS ROWS.
inline RawRaster read_raw(const Arguments& arguments) {
  RawRaster raster;
  raster.cols = static_cast<int>(arguments.number(1));
  raster.rows = static_cast<int>(arguments.number(2));
  if (raster.cols < 2 || raster.rows < 2) die("COLS and ROWS must be at least 2");
  raster.samples.resize(static_cast<std::size_t>(raster.cols) * static_cast<std::size_t>(raster.rows));
  const File file = open_file(arguments[0], "rb");
  if (std::fread(raster.samples.data(), sizeof(float), raster.samples.size(), file.get()) != raster.samples.size())
    die(arguments[0] + " holds fewer samples than COLS times ROWS");
  return raster;
}

inline RawRaster window_of(const RawRaster& raster, int col, int row, int cols, int rows) {
  RawRaster part{{}, cols, rows};
  for (int y = row; y < row + rows; ++y) {
    const auto begin = raster.samples.begin() + static_cast<std::ptrdiff_t>(y) * raster.cols + col;
    part.samples.insert(part.samples.end(), begin, begin + cols);
  }
  return part;
}

/// The input of the warm-up: the raster itself, or its upper left 512×512 samples if it has more than 2 million.
inline RawRaster warm_up_part(const RawRaster& raster) {
  if (raster.samples.size() <= 2'000'000) return raster;
  return window_of(raster, 0, 0, std::min(raster.cols, 512), std::min(raster.rows, 512));
}

/// Vertices with kPer numbers each, triangles as triples of their ids.
template <class Number, std::size_t kPer>
struct ArrayMesh {
  static constexpr std::size_t kNumbers = kPer;
  std::vector<Number> points;
  std::vector<std::uint32_t> triangles;
};
using RawMesh = ArrayMesh<std::uint32_t, 2>;  ///< (column, row) pairs
using Surface = ArrayMesh<double, 3>;         ///< (column, rows − 1 − row, z), counter-clockwise from above

/// Two counts (native uint32), then the two arrays.
template <class Mesh>
void write_mesh(const std::string& path, const Mesh& mesh) {
  const File file = open_file(path, "wb");
  const std::uint32_t counts[2] = {static_cast<std::uint32_t>(mesh.points.size() / Mesh::kNumbers),
                                   static_cast<std::uint32_t>(mesh.triangles.size() / 3)};
  const auto write = [&](const auto* data, std::size_t count) {
    if (std::fwrite(data, sizeof *data, count, file.get()) != count) die("cannot write " + path);
  };
  write(counts, 2);
  write(mesh.points.data(), mesh.points.size());
  write(mesh.triangles.data(), mesh.triangles.size());
}

template <class Mesh>
Mesh read_mesh(const std::string& path) {
  const File file = open_file(path, "rb");
  const auto read = [&](auto* data, std::size_t count) {
    if (std::fread(data, sizeof *data, count, file.get()) != count) die(path + " is not a whole mesh");
  };
  std::uint32_t counts[2] = {};
  read(counts, 2);
  Mesh mesh;
  mesh.points.resize(Mesh::kNumbers * std::size_t{counts[0]});
  mesh.triangles.resize(3 * std::size_t{counts[1]});
  read(mesh.points.data(), mesh.points.size());
  read(mesh.triangles.data(), mesh.triangles.size());
  return mesh;
}

}  // namespace bench
