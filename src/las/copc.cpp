#include "las/copc.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace scarp::las {
namespace {

constexpr std::uint64_t kHeaderBytes = 375, kRecordHeader = 54, kInfoBytes = 160, kEntryBytes = 32;

struct Page {
  std::uint64_t offset, bytes;
};

class Octree {
 public:
  Octree(const Source& source, const Header& header, const Extent& extent) : source_(source), extent_(extent) {
    // Extends the cubes slightly, for the rounding of their sides.
    hair_ = {header.scale[0], header.scale[1]};
    constexpr std::uint64_t kEmptyNodes = 1 << 16;
    most_entries_ = header.points + kEmptyNodes;
  }

  bool read(const std::array<std::uint8_t, kInfoBytes>& info) {
    centre_ = {load<double>(info.data()), load<double>(info.data() + 8)};
    half_ = load<double>(info.data() + 24);
    if (!std::isfinite(centre_[0]) || !std::isfinite(centre_[1]) || !(half_ > 0 && half_ < 1e300)) return false;
    std::vector<Page> pages{{load<std::uint64_t>(info.data() + 40), load<std::uint64_t>(info.data() + 48)}};
    std::uint64_t entries = 0;
    while (!pages.empty()) {
      const Page page = pages.back();
      pages.pop_back();
      if (page.bytes % kEntryBytes != 0 || !source_.holds(page.offset, page.bytes)) return false;
      entries += page.bytes / kEntryBytes + 1;
      if (entries > most_entries_) return false;  // pages that refer to each other would never end
      std::vector<std::uint8_t> bytes(page.bytes);
      if (!source_.read(page.offset, bytes)) return false;
      for (std::uint64_t at = 0; at < bytes.size(); at += kEntryBytes) add(bytes.data() + at, pages);
    }
    return true;
  }

  const std::unordered_set<std::uint64_t>& outside() const { return outside_; }

 private:
  void add(const std::uint8_t* entry, std::vector<Page>& pages) {
    const auto level = load<std::int32_t>(entry);
    const auto offset = load<std::uint64_t>(entry + 16);
    const auto bytes = load<std::int32_t>(entry + 24), points = load<std::int32_t>(entry + 28);
    if (points < 0) return pages.push_back({offset, static_cast<std::uint64_t>(std::max(bytes, 0))});
    constexpr std::int32_t kDeepest = 31;  // keys have 32 bits
    if (level < 0 || level > kDeepest) return;
    const double side = std::ldexp(half_, 1 - level);
    for (int k = 0; k < 2; ++k) {
      const double first = centre_[k] - half_ + side * load<std::int32_t>(entry + 4 + 4 * k);
      if (first > extent_[k + 2] + hair_[k] || first + side < extent_[k] - hair_[k]) {
        outside_.insert(offset);
        return;
      }
    }
  }

  const Source& source_;
  const Extent& extent_;
  std::array<double, 2> centre_{}, hair_{};
  double half_ = 0;
  std::uint64_t most_entries_ = 0;
  std::unordered_set<std::uint64_t> outside_;
};

}  // namespace

std::unordered_set<std::uint64_t> find_chunks_outside(const Source& source, const Header& header,
                                                      const Extent& extent) {
  std::array<std::uint8_t, kRecordHeader> record{};
  std::array<std::uint8_t, kInfoBytes> info{};
  const bool may_be =
      header.laz && header.minor_version == 4 && source.holds(kHeaderBytes, record.size() + info.size());
  if (!may_be || !source.read(kHeaderBytes, record) || !source.read(kHeaderBytes + kRecordHeader, info)) return {};
  constexpr char kUser[] = "copc";
  if (std::memcmp(record.data() + 2, kUser, sizeof kUser) != 0 || load<std::uint16_t>(record.data() + 18) != 1)
    return {};
  Octree octree(source, header, extent);
  return octree.read(info) ? octree.outside() : std::unordered_set<std::uint64_t>();
}

}  // namespace scarp::las
