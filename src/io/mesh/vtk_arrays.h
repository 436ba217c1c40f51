// The uncompressed arrays of VTK's XML files: text, base64, or raw bytes after the XML.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/file_bytes.h"
#include "scarp/result.h"

namespace scarp::io {

enum class VtkType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

/// "Float64", "UInt8" …; nothing if VTK has no such numeric type.
std::optional<VtkType> find_vtk_type(std::string_view name);

/// The root element's attributes that all arrays share, and the bytes after the XML.
struct VtkFile {
  std::endian order = std::endian::little;
  bool wide_lengths = false;               ///< lengths of arrays have 64 bits, not 32
  std::span<const std::uint8_t> appended;  ///< starts after the mark '_'; in base64 if `is_base64`
  bool is_base64 = false;
};

/// A DataArray element.
struct VtkArray {
  enum class Format { kText, kBase64, kAppended };
  VtkType type = VtkType::kFloat64;
  Format format = Format::kText;
  std::uint64_t offset = 0;  ///< from the mark; only for kAppended
  std::string content;       ///< for the other formats
};

/// The numbers of an array in any encoding.
class VtkNumbers {
 public:
  VtkNumbers() = default;
  VtkNumbers(VtkNumbers&&) = default;  // not copyable: bytes_ may refer to owned_
  VtkNumbers& operator=(VtkNumbers&&) = default;

  std::size_t size() const { return bytes_.size() / width_; }
  bool is_float() const { return type_ == VtkType::kFloat32 || type_ == VtkType::kFloat64; }
  std::size_t bytes() const { return bytes_.size(); }
  double real(std::size_t i) const;
  /// The integer; −1 for other numbers, and for integers beyond 63 bits.
  std::int64_t whole(std::size_t i) const;

 private:
  friend Result<VtkNumbers> read_vtk_array(const VtkFile& file, const VtkArray& array);
  VtkType type_ = VtkType::kFloat64;
  std::size_t width_ = 8;
  std::endian order_ = std::endian::little;
  std::vector<std::uint8_t> owned_;
  std::span<const std::uint8_t> bytes_;
};

/// Fails with kInput and half a sentence ("is cut off", …) if the array is damaged. REQUIRES: the file outlives the
/// result.
Result<VtkNumbers> read_vtk_array(const VtkFile& file, const VtkArray& array);

}  // namespace scarp::io
