// Common parts of the programs of bench/speed: raw rasters, clocks, the line they report, and the mesh file for the
// judge.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace bench {

/// Native-endian float32 samples without a header, row by row.
struct RawRaster {
  std::vector<float> samples;
  int cols = 0, rows = 0;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] inline void die(const std::string& sentence) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  std::exit(2);
}

inline File open_file(const char* path, const char* mode) {
  File file(std::fopen(path, mode), &std::fclose);
  if (!file) die(std::string("cannot open ") + path);
  return file;
}

inline RawRaster read_raw(const char* path, const char* cols, const char* rows) {
  RawRaster raster;
  raster.cols = std::atoi(cols);
  raster.rows = std::atoi(rows);
  if (raster.cols < 2 || raster.rows < 2) die("COLS and ROWS must be at least 2");
  raster.samples.resize(static_cast<std::size_t>(raster.cols) * static_cast<std::size_t>(raster.rows));
  const File file = open_file(path, "rb");
  if (std::fread(raster.samples.data(), sizeof(float), raster.samples.size(), file.get()) != raster.samples.size())
    die(std::string(path) + " holds fewer samples than COLS times ROWS");
  return raster;
}

/// The input of the warm-up: the raster itself, or its upper left 512×512 samples where it has more than 2 million.
inline RawRaster warm_up_part(const RawRaster& raster) {
  if (raster.samples.size() <= 2'000'000) return raster;
  RawRaster part;
  part.cols = raster.cols < 512 ? raster.cols : 512;
  part.rows = raster.rows < 512 ? raster.rows : 512;
  for (int row = 0; row < part.rows; ++row) {
    const auto begin = raster.samples.begin() + static_cast<std::ptrdiff_t>(row) * raster.cols;
    part.samples.insert(part.samples.end(), begin, begin + part.cols);
  }
  return part;
}

/// Vertices as (column, row) pairs, triangles as triples of ids.
struct RawMesh {
  std::vector<std::uint32_t> vertices, triangles;
};

/// Two counts, then the two arrays, all native uint32.
inline void write_raw_mesh(const char* path, const RawMesh& mesh) {
  const File file = open_file(path, "wb");
  const std::uint32_t counts[2] = {static_cast<std::uint32_t>(mesh.vertices.size() / 2),
                                   static_cast<std::uint32_t>(mesh.triangles.size() / 3)};
  const bool written =
      std::fwrite(counts, sizeof counts, 1, file.get()) == 1 &&
      std::fwrite(mesh.vertices.data(), 4, mesh.vertices.size(), file.get()) == mesh.vertices.size() &&
      std::fwrite(mesh.triangles.data(), 4, mesh.triangles.size(), file.get()) == mesh.triangles.size();
  if (!written) die(std::string("cannot write ") + path);
}

inline RawMesh read_raw_mesh(const char* path) {
  const File file = open_file(path, "rb");
  std::uint32_t counts[2] = {};
  RawMesh mesh;
  bool read = std::fread(counts, sizeof counts, 1, file.get()) == 1;
  mesh.vertices.resize(2 * std::size_t{counts[0]});
  mesh.triangles.resize(3 * std::size_t{counts[1]});
  read = read && std::fread(mesh.vertices.data(), 4, mesh.vertices.size(), file.get()) == mesh.vertices.size() &&
         std::fread(mesh.triangles.data(), 4, mesh.triangles.size(), file.get()) == mesh.triangles.size();
  if (!read) die(std::string(path) + " is not a whole mesh");
  return mesh;
}

/// Times of a stretch of work, all threads together.
struct Times {
  double wall = 0, user = 0, system = 0;  // seconds
  double page_faults = 0;                 // pages mapped: exact where the kernel only samples system time

  double cpu() const { return user + system; }
};

/// Since it was made.
class Stopwatch {
 public:
  Times read() const {
    const Times now = used();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(), now.user - start_.user,
            now.system - start_.system, now.page_faults - start_.page_faults};
  }
  double wall() const { return read().wall; }
  double cpu() const { return read().cpu(); }

 private:
  static double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  static Times used() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {0, seconds(usage.ru_utime), seconds(usage.ru_stime), static_cast<double>(usage.ru_minflt)};
  }
  Times start_ = used();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// "seconds": …, of `times`, as members of a JSON object.
inline std::string json_of(const Times& times) {
  char text[200];
  std::snprintf(text, sizeof text,
                "\"seconds\": %.6f, \"cpu_seconds\": %.6f, \"user_seconds\": %.6f, \"system_seconds\": %.6f, "
                "\"page_faults\": %.1f",
                times.wall, times.cpu(), times.user, times.system, times.page_faults);
  return text;
}

/// The one line of a timed program, JSON; `more`: further members, each with a comma before it.
inline void print_result(const std::string& version, const Times& times, std::size_t vertices, std::size_t triangles,
                         const std::string& more = "") {
  std::printf("{\"version\": \"%s\", %s, \"vertices\": %zu, \"triangles\": %zu%s}\n", version.c_str(),
              json_of(times).c_str(), vertices, triangles, more.c_str());
}

}  // namespace bench
