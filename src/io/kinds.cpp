#include "io/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "io/commands.h"
#include "io/mesh/formats.h"
#include "io/mesh/mesh_file_text.h"

namespace scarp::io {
namespace {

enum class Way { kMesh, kLas, kCloud, kCloudOrMesh, kHeadless, kUnpack, kFetch, kDownload, kSaveAsText };

struct KindRow {
  std::string_view magic;       ///< first bytes; empty: the name decides
  std::string_view extensions;  ///< separated by blanks
  const char* is;
  Way way;
};

constexpr std::array kKinds{
    KindRow{"LASF", " .las .laz ", "a LAS point cloud", Way::kLas},
    KindRow{"ASTM-E57", " .e57 ", "an E57 point cloud", Way::kCloud},
    KindRow{"# .PCD", " .pcd ", "a PCD point cloud", Way::kCloud},
    KindRow{"ply\n", " .ply ", "a PLY file", Way::kCloudOrMesh},
    KindRow{"ply\r", " .ply ", "a PLY file", Way::kCloudOrMesh},
    KindRow{"", " .gltf .off .fbx .dae .3ds .blend .usdz ", "a mesh", Way::kMesh},
    KindRow{"\x1f\x8b", " .gz .tgz ", "compressed by gzip", Way::kUnpack},
    KindRow{"BZh", " .bz2 ", "compressed by bzip2", Way::kUnpack},
    KindRow{"\xfd"
            "7zXZ",
            " .xz ", "compressed by xz", Way::kUnpack},
    KindRow{"\x28\xb5\x2f\xfd", " .zst ", "compressed by zstd", Way::kUnpack},
    KindRow{"7z\xbc\xaf", " .7z ", "a 7z archive", Way::kUnpack},
    KindRow{"Rar!", " .rar ", "a RAR archive", Way::kUnpack},
    KindRow{"AutoCAD Binary DXF", "", "a binary DXF", Way::kSaveAsText},
    KindRow{"version https://git-lfs", "", "a pointer of Git LFS in place of the file", Way::kFetch},
    KindRow{"<!DOCTYPE html", "", "a web page in place of the file", Way::kDownload},
    KindRow{"<!doctype html", "", "a web page in place of the file", Way::kDownload},
    KindRow{"<html", "", "a web page in place of the file", Way::kDownload},
    KindRow{"", " .raw .r16 .r32 .bin .f32 .flt .bil .bsq ", "a raster without a header", Way::kHeadless},
};

const KindRow* find_kind(std::string_view head, const std::string& extension) {
  for (const KindRow& row : kKinds) {
    if (!row.magic.empty() && head.starts_with(row.magic)) return &row;
  }
  const auto row = std::find_if(kKinds.begin(), kKinds.end(), [&](const KindRow& of) {
    return !extension.empty() && of.extensions.find(" " + extension + " ") != std::string_view::npos;
  });
  return row != kKinds.end() ? row : nullptr;
}

/// The title of a supported mesh format, by mark or name; empty for others.
std::string find_mesh_title(std::string_view head, const std::string& extension) {
  for (const MeshFormatRow& row : mesh_format_rows()) {
    const bool is_root = row.mark.starts_with('<') && head.starts_with('<') && head.find(row.mark) != head.npos;
    if (!row.mark.empty() && (is_root || head.starts_with(row.mark))) return row.traits.title;
  }
  const auto named = extension.empty() ? std::nullopt : find_mesh_format(extension);
  const bool is_mesh = named && traits_of(*named).is_read && extension.substr(1) != traits_of(*named).shared;
  return is_mesh ? traits_of(*named).title : "";
}

/// "UTF-16" by its mark, "UTF-16LE" or "UTF-16BE" by the zeros of the first characters; else empty.
const char* find_wide_encoding(std::string_view head) {
  if (head.size() < 4) return "";
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")) return "UTF-16";
  const auto is_letter = [](char first, char second) { return first >= 9 && first < 127 && second == 0; };
  if (is_letter(head[0], head[1]) && is_letter(head[2], head[3])) return "UTF-16LE";
  return is_letter(head[1], head[0]) && is_letter(head[3], head[2]) ? "UTF-16BE" : "";
}

std::string through_pdal(const std::string& path) {
  return fmt::format(
      "make a text of its points first (pdal translate {} {} --writers.text.order=X:9,Y:9,Z:4 "
      "--writers.text.keep_unspecified=false --writers.text.quote_header=false)",
      file_word(path), new_file(".csv"));
}

std::string from_its_source(const std::string& path) {
  return fmt::format("give the raster or the points that it was made from ('scarp info {}' describes the mesh)",
                     file_word(path));
}

/// Advice on an ENVI header for GDAL. Assumes that height maps of games are square and have 16 bits.
std::string with_header(const std::string& path, const std::string& extension, std::uint64_t bytes) {
  const bool is_float = extension == ".r32" || extension == ".f32" || extension == ".flt";
  const auto side =
      static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(bytes) / (is_float ? 4 : 2))));
  const bool is_square = side > 1 && side * side * (is_float ? 4 : 2) == bytes;
  const auto size = [&](const char* otherwise) { return is_square ? fmt::format("{}", side) : otherwise; };
  const std::string header = std::filesystem::path(path).replace_extension(".hdr").string();
  return fmt::format(
      "write one (printf 'ENVI\\nsamples = {}\\nlines = {}\\nbands = 1\\ndata type = {}\\nbyte order = 0\\n' > {}), in "
      "which the types 1, 2, 4 and 12 are uint8, int16, float32 and uint16, and the byte order 1 is big-endian",
      size("COLUMNS"), size("ROWS"), is_float ? 4 : 12, file_word(header));
}

std::string unpack(const std::string& path, const std::string& extension) {
  const std::string file = file_word(path);
  if (extension == ".7z") return fmt::format("unpack it first (7z x {})", file);
  if (extension == ".rar") return fmt::format("unpack it first (unrar x {})", file);
  const bool is_tar = extension == ".tgz" || path.ends_with(".tar" + extension);
  if (is_tar) return fmt::format("unpack it first (tar -xf {})", file);
  const char* program = extension == ".bz2"   ? "bunzip2"
                        : extension == ".xz"  ? "unxz"
                        : extension == ".zst" ? "unzstd"
                                              : "gunzip";
  return fmt::format("unpack it first ({} -k {})", program, file);
}

}  // namespace

std::string describe_wide_text(const std::string& path, std::string_view head) {
  const std::string encoding = find_wide_encoding(head);
  return encoding.empty() ? ""
                          : fmt::format("text in {}: make UTF-8 of it ({})", encoding, utf8_command(encoding, path));
}

std::string describe_marked_text(const std::string& path, std::string_view head) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (!head.starts_with(kMark) || head.substr(kMark.size()).starts_with('<')) return "";
  return fmt::format("text that begins with the mark of UTF-8: omit the mark ({})", skip_command(kMark.size(), path));
}

std::string describe_kind(const std::string& path, std::string_view head, std::uint64_t bytes, bool by_name) {
  const std::string extension = lowered(std::filesystem::path(path).extension().string());
  const KindRow* row = find_kind(head, by_name ? extension : "");
  if (row == nullptr) {
    // SRTM tiles have no header, and may begin like a mark: with a height of -2.
    std::string wide = extension == ".hgt" ? "" : describe_wide_text(path, head);
    if (!wide.empty()) return wide;
    const std::string title = find_mesh_title(head, by_name ? extension : "");
    const bool is_landxml = title == traits_of(MeshFormat::kLandXml).title;
    return title.empty() ? ""
                         : fmt::format("a mesh ({}): {}{}", title, from_its_source(path),
                                       is_landxml ? ", or read its vertices as points (--points)" : "");
  }
  const auto tell = [&](const std::string& way) { return fmt::format("{}: {}", row->is, way); };
  switch (row->way) {
    case Way::kMesh:
      return tell(from_its_source(path));
    case Way::kLas:
      return tell(
          fmt::format("simplify, measure, info and tile read it as points (--points); for others make a raster of it "
                      "first ({})",
                      rasterize_command(path)));
    case Way::kCloud:
      return tell(through_pdal(path));
    case Way::kCloudOrMesh:
      return head.find("element face") != std::string_view::npos ? "a mesh (PLY): " + from_its_source(path)
                                                                 : "a PLY point cloud: " + through_pdal(path);
    case Way::kHeadless:
      return tell(with_header(path, extension, bytes));
    case Way::kUnpack:
      return tell(unpack(path, extension));
    case Way::kFetch:
      return tell("fetch the file first (git lfs pull)");
    case Way::kSaveAsText:
      return tell("save it as a DXF in text (ASCII)");
    case Way::kDownload:
      break;
  }
  return tell("fetch the file again, most likely from another address");
}

}  // namespace scarp::io
