#include "io/mesh/vtk_arrays.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "io/base64.h"
#include "io/mesh/mesh_file_text.h"

namespace scarp::io {
namespace {

struct VtkTypeName {
  std::string_view name;
  VtkType type;
  std::size_t width;
};
constexpr VtkTypeName kTypes[] = {{"Int8", VtkType::kInt8, 1},       {"UInt8", VtkType::kUint8, 1},
                                  {"Int16", VtkType::kInt16, 2},     {"UInt16", VtkType::kUint16, 2},
                                  {"Int32", VtkType::kInt32, 4},     {"UInt32", VtkType::kUint32, 4},
                                  {"Int64", VtkType::kInt64, 8},     {"UInt64", VtkType::kUint64, 8},
                                  {"Float32", VtkType::kFloat32, 4}, {"Float64", VtkType::kFloat64, 8}};

std::size_t width_of(VtkType type) {
  for (const VtkTypeName& known : kTypes) {
    if (known.type == type) return known.width;
  }
  return 1;
}

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::uint64_t load_length(const VtkFile& file, const std::uint8_t* at) {
  return file.wide_lengths ? load_number<std::uint64_t>(at, file.order) : load_number<std::uint32_t>(at, file.order);
}

/// Integers are stored as int64, all others as double, both little-endian.
bool read_text(std::string_view text, bool as_float, std::vector<std::uint8_t>& bytes) {
  TextCursor cursor(bytes_of(text));
  for (std::string_view word = cursor.word_anywhere(); !word.empty(); word = cursor.word_anywhere()) {
    double real = 0;
    std::int64_t whole = 0;
    if (as_float ? !parse_number(word, real) : !parse_integer(word, whole)) return false;
    bytes.resize(bytes.size() + 8);
    std::uint8_t* at = bytes.data() + bytes.size() - 8;
    if (as_float) {
      store_number(at, real);
    } else {
      store_number(at, whole);
    }
  }
  return true;
}

/// Decodes the array's length in bytes, and the bytes, from base64.
bool read_letters(const VtkFile& file, std::span<const std::uint8_t> letters, std::vector<std::uint8_t>& bytes) {
  const std::size_t head = file.wide_lengths ? 8 : 4;
  if (!read_base64(letters, head, bytes)) return false;
  const std::uint64_t length = load_length(file, bytes.data());
  if (length > letters.size() + 3) return false;  // each letter encodes less than a byte
  if (!read_base64(letters, head + length, bytes)) return false;
  bytes.resize(head + length);
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(head));
  return true;
}

tl::unexpected<Error> broken(const char* what) { return fail(ErrorKind::kInput, what); }

}  // namespace

std::optional<VtkType> find_vtk_type(std::string_view name) {
  for (const VtkTypeName& known : kTypes) {
    if (known.name == name) return known.type;
  }
  return {};
}

double VtkNumbers::real(std::size_t i) const {
  const std::uint8_t* at = &bytes_[i * width_];
  if (type_ == VtkType::kFloat32) return load_number<float>(at, order_);
  if (type_ == VtkType::kFloat64) return load_number<double>(at, order_);
  return static_cast<double>(whole(i));
}

std::int64_t VtkNumbers::whole(std::size_t i) const {
  const std::uint8_t* at = &bytes_[i * width_];
  switch (type_) {
    case VtkType::kInt8:
      return load_number<std::int8_t>(at, order_);
    case VtkType::kUint8:
      return load_number<std::uint8_t>(at, order_);
    case VtkType::kInt16:
      return load_number<std::int16_t>(at, order_);
    case VtkType::kUint16:
      return load_number<std::uint16_t>(at, order_);
    case VtkType::kInt32:
      return load_number<std::int32_t>(at, order_);
    case VtkType::kUint32:
      return load_number<std::uint32_t>(at, order_);
    case VtkType::kInt64:
      return load_number<std::int64_t>(at, order_);
    case VtkType::kUint64: {
      const auto value = load_number<std::uint64_t>(at, order_);
      return value >> 63 == 0 ? static_cast<std::int64_t>(value) : -1;
    }
    case VtkType::kFloat32:
    case VtkType::kFloat64:
      break;
  }
  return -1;
}

Result<VtkNumbers> read_vtk_array(const VtkFile& file, const VtkArray& array) {
  VtkNumbers numbers;
  numbers.type_ = array.type;
  numbers.width_ = width_of(array.type);
  numbers.order_ = file.order;
  const auto take = [&] { numbers.bytes_ = numbers.owned_; };
  if (array.format == VtkArray::Format::kText) {
    if (!read_text(array.content, numbers.is_float(), numbers.owned_)) return broken("holds a word that is no number");
    numbers.type_ = numbers.is_float() ? VtkType::kFloat64 : VtkType::kInt64;
    numbers.width_ = 8;
    numbers.order_ = std::endian::little;
    take();
    return numbers;
  }
  const bool is_appended = array.format == VtkArray::Format::kAppended;
  std::span<const std::uint8_t> from = is_appended ? file.appended : bytes_of(array.content);
  if (is_appended && array.offset > from.size()) return broken("begins behind the end of the file");
  if (is_appended) from = from.subspan(array.offset);
  if (!is_appended || file.is_base64) {
    while (!from.empty() && (from.front() == '\n' || from.front() == ' ' || from.front() == '\t')) {
      from = from.subspan(1);
    }
    if (!read_letters(file, from, numbers.owned_)) return broken("is damaged or cut off");
    take();
  } else {
    const std::size_t head = file.wide_lengths ? 8 : 4;
    if (from.size() < head) return broken("is cut off");
    const std::uint64_t length = load_length(file, from.data());
    if (length > from.size() - head) return broken("is cut off");
    numbers.bytes_ = from.subspan(head, length);
  }
  if (numbers.bytes_.size() % numbers.width_ != 0) return broken("ends within a number");
  return numbers;
}

}  // namespace scarp::io
