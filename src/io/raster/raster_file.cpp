#include "io/raster/raster_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/caught.h"

namespace scarp {
namespace {

tl::unexpected<Error> name_path(const std::string& path, const Error& error) {
  return fail(error.kind, fmt::format("cannot write {}: {}", path, error.message));
}

}  // namespace

RasterFile::RasterFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;
RasterFile::~RasterFile() = default;

Result<RasterFile> RasterFile::create(const std::string& path, int cols, int rows, const RasterInfo* like,
                                      bool overwrite) try {
  SCARP_TRY(auto&& staged, io::StagedFile::begin(path, overwrite, true));
  auto tiff = io::create_geotiff(staged.name(), cols, rows, like);
  if (!tiff) return name_path(path, tiff.error());
  auto impl = std::make_unique<Impl>(Impl{std::move(staged), std::move(*tiff), cols, rows});
  impl->held.reserve(static_cast<std::size_t>(cols) * static_cast<std::size_t>(std::min(rows, io::kRowsOfBlock)));
  return RasterFile(std::move(impl));
} catch (...) {
  return caught(ErrorKind::kOutput, "write " + path);
}

Result<void> RasterFile::add(std::span<const float> row) try {
  Impl& at = *impl_;
  at.held.insert(at.held.end(), row.begin(), row.end());
  const int count = static_cast<int>(at.held.size() / static_cast<std::size_t>(at.cols));
  if (count < io::kRowsOfBlock && at.written + count < at.rows) return {};
  if (auto written = at.tiff->write(at.written, count, at.held.data()); !written)
    return name_path(at.staged.path(), written.error());
  at.written += count;
  at.held.clear();
  return {};
} catch (...) {
  return caught(ErrorKind::kOutput, "write " + impl_->staged.path());
}

Result<void> RasterFile::finish() {
  if (auto closed = impl_->tiff->close(); !closed) return name_path(impl_->staged.path(), closed.error());
  SCARP_RETURN_IF_ERROR(impl_->staged.end());
  impl_->size = impl_->staged.size();
  return {};
}

std::uint64_t RasterFile::size() const { return impl_->size; }

std::uint64_t RasterFile::bytes(int cols) {
  constexpr std::uint64_t kBytesToEncode = 2'000'000;  // a block, its copies and the compressor
  return kBytesToEncode +
         sizeof(float) * static_cast<std::uint64_t>(cols) * static_cast<std::uint64_t>(io::kRowsOfBlock);
}

}  // namespace scarp
