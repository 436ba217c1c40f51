// Small rasters on disk, written without GDAL: ENVI (raw numbers and a text header), VRT over ENVI, Esri ASCII.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "source_dir.h"

namespace scarp::testing {

/// A temporary folder, removed by the destructor.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "scarp-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// ENVI's number for a sample type.
template <class T>
constexpr int kEnviType = 0;
template <>
inline constexpr int kEnviType<std::uint8_t> = 1;
template <>
inline constexpr int kEnviType<std::int16_t> = 2;
template <>
inline constexpr int kEnviType<std::int32_t> = 3;
template <>
inline constexpr int kEnviType<float> = 4;
template <>
inline constexpr int kEnviType<double> = 5;
template <>
inline constexpr int kEnviType<std::uint16_t> = 12;
template <>
inline constexpr int kEnviType<std::uint32_t> = 13;

/// Writes `path` and `path`.hdr, band by band. `more`: further header lines.
template <class T>
void write_envi(const std::string& path, int cols, int rows, const std::vector<T>& values,
                const std::string& more = "") {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  const auto bands = values.size() / static_cast<std::size_t>(cols * rows);
  write_text(path + ".hdr",
             "ENVI\nsamples = " + std::to_string(cols) + "\nlines = " + std::to_string(rows) +
                 "\nbands = " + std::to_string(bands) + "\nheader offset = 0\nfile type = ENVI Standard\n" +
                 "data type = " + std::to_string(kEnviType<T>) + "\ninterleave = bsq\nbyte order = 0\n" + more);
}

/// Writes raw numbers as a VRT of one band, for the 64-bit integers that ENVI files lack.
template <class T>
void write_raw_vrt(const std::string& path, int cols, int rows, const std::vector<T>& values, const std::string& type,
                   const std::string& band) {
  std::ofstream(path + ".raw", std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  write_text(path, "<VRTDataset rasterXSize=\"" + std::to_string(cols) + "\" rasterYSize=\"" + std::to_string(rows) +
                       "\"><VRTRasterBand dataType=\"" + type + "\" band=\"1\" subClass=\"VRTRawRasterBand\">" + band +
                       "<SourceFilename relativeToVRT=\"1\">" + std::filesystem::path(path).filename().string() +
                       ".raw</SourceFilename><ImageOffset>0</ImageOffset><PixelOffset>" + std::to_string(sizeof(T)) +
                       "</PixelOffset><LineOffset>" + std::to_string(sizeof(T) * static_cast<std::size_t>(cols)) +
                       "</LineOffset><ByteOrder>LSB</ByteOrder></VRTRasterBand></VRTDataset>");
}

/// A VRT with one band over band 1 of `source` (in the same folder). `head` is added to the dataset, `band` to the
/// band.
inline void write_vrt(const std::string& path, const std::string& source, int cols, int rows, const std::string& type,
                      const std::string& head, const std::string& band) {
  const std::string size = "xSize=\"" + std::to_string(cols) + "\" ySize=\"" + std::to_string(rows) + "\"";
  write_text(path, "<VRTDataset rasterXSize=\"" + std::to_string(cols) + "\" rasterYSize=\"" + std::to_string(rows) +
                       "\">" + head + "<VRTRasterBand dataType=\"" + type + "\" band=\"1\">" + band +
                       "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + source +
                       "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\" " + size +
                       "/><DstRect xOff=\"0\" yOff=\"0\" " + size + "/></SimpleSource></VRTRasterBand></VRTDataset>");
}

/// "<SRS>…</SRS><GeoTransform>…</GeoTransform>" for write_vrt().
inline std::string vrt_position(const std::string& crs, const std::string& geotransform) {
  return (crs.empty() ? "" : "<SRS dataAxisToSRSAxisMapping=\"1,2\">" + crs + "</SRS>") + "<GeoTransform>" +
         geotransform + "</GeoTransform>";
}

inline bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0;
}

/// True if the command succeeded.
inline bool run(const std::string& command) { return std::system(command.c_str()) == 0; }

/// The error from reading `path`; its message must be one line that names the file.
inline Error read_error(const std::string& path, const ReadOptions& options = {}) {
  const auto read = read_height_field(path, options);
  if (read) {
    ADD_FAILURE() << path << " was read";
    return {};
  }
  EXPECT_NE(read.error().message.find(path), std::string::npos) << read.error().message;
  EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << read.error().message;
  return read.error();
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// True if one of the warnings contains `part`.
inline bool warns(const RasterInfo& info, const std::string& part) {
  for (const std::string& warning : info.warnings) {
    if (contains(warning, part)) return true;
  }
  return false;
}

/// The folder of shared reference rasters; empty if missing.
inline std::string reference_folder() {
  const char* given = std::getenv("SCARP_SHARED");
  const std::string folder =
      (given != nullptr ? std::string(given) : source_dir() + "/../shared") + "/data/";
  return std::filesystem::is_directory(folder) ? folder : "";
}

}  // namespace scarp::testing
