// Files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "scarp/progress.h"
#include "scarp/result.h"

namespace scarp {

enum class Decode { kNone, kTerrarium, kMapbox };

struct ReadOptions {
  int band = 1;                   ///< 1-based
  std::optional<double> nodata = std::nullopt;   ///< overrides the file's value, which then is an ordinary height
  Decode decode = Decode::kNone;  ///< heights packed into red, green, blue (8 bit each); alpha 0 is nodata
  /// Frame of the mesh. Empty (DEFAULT): the local metric frame for geographic rasters, the raster's own CRS for
  /// projected ones, the grid frame without georeference. "source": the raster's own coordinates. "local": the local
  /// metric frame. "grid": columns and rows. Anything else is a CRS for GDAL ("EPSG:32611", WKT, PROJ string).
  std::string crs = {};
  /// Refuse to read a raster that needs more memory than this, in bytes; 0 = the machine's memory. DEFAULT: 0.
  std::uint64_t memory_limit = 0;
  ProgressCallback progress = {};
};

/// Reads one raster. PGM (P2, P5) and Scape's STM by readers of our own; all else, with any path or URL that GDAL opens
/// (/vsicurl/, /vsizip/, http:// and https:// included), by GDAL.
/// nodata (declared, overridden, mask band, alpha, NaN, ±infinity) becomes NaN.
/// Fails with kInput: missing, not a raster, truncated, fewer than 2×2 samples, band out of range, no valid sample;
/// kUsage for a CRS that is unknown or cannot be reached.
Result<OwnedHeightField> read_height_field(const std::string& path, const ReadOptions& options = {});

/// Largest number of samples that fit `memory_limit` bytes at 5 bytes a sample; 0 = the machine's memory.
std::uint64_t max_samples(std::uint64_t memory_limit);

enum class MeshFormat { kGlb, kObj, kPly, kStl };

/// From a name ("glb", "OBJ", …) or from a path's extension; nothing if unknown.
std::optional<MeshFormat> find_mesh_format(const std::string& name_or_path);

/// The file's bytes. GLB: y up (x, z, −y), float32, origin as node translation, metadata in asset.extras. OBJ: text,
/// absolute coordinates that read back to the same doubles, metadata as comments. PLY: binary little-endian, double,
/// absolute. STL: binary, float32 offsets from the origin, z up. Deterministic. Fails with kOutput where the format
/// cannot hold the mesh.
Result<std::vector<std::uint8_t>> encode_mesh(const Mesh& mesh, MeshFormat format);
/// Reads any of the four formats; recognises the format by content. Never trusts a length or an index in the file.
Result<Mesh> decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors);

/// encode_mesh() to a temporary name beside `path`, then renamed; nothing is left behind on failure.
/// Fails with kOutput, also if `path` exists and `overwrite` is false.
Result<void> write_mesh(const Mesh& mesh, const std::string& path, std::optional<MeshFormat> format = {},
                        bool overwrite = true);
Result<Mesh> read_mesh(const std::string& path);

/// Writes bytes to a temporary name beside `path` (".scarp-R.tmp", R: 16 random hexadecimal digits) and renames it.
/// kOutput on any failure, with nothing left behind; also if `path` exists and `overwrite` is false. A symbolic link is
/// followed, also to a file that does not exist yet; an existing file keeps its permissions. /dev/stdout, and existing devices and pipes, are written directly. A program that wants "file
/// too large" as an error rather than as its end ignores SIGXFSZ.
Result<void> write_file(const std::string& path, std::span<const std::uint8_t> bytes, bool overwrite = true);
/// The whole file (or pipe). kInput if it cannot be read.
Result<std::vector<std::uint8_t>> read_file(const std::string& path);

/// For signal handlers: the temporary name that write_file() is writing just now, for unlink(); empty if there is none.
/// Points to a static buffer; async-signal-safe. If several threads write at once, the first one's.
const char* pending_output();

/// 8-bit RGB, row-major, top row first.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
Result<std::vector<std::uint8_t>> encode_png(const Picture& picture);

}  // namespace scarp
