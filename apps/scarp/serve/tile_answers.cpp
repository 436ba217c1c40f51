#include "serve/tile_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>

#include "io/gzip.h"
#include "serve/media_types.h"
#include "serve/set_page.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// More bytes than any tile needs.
constexpr std::size_t kMostUnpacked = std::size_t{1} << 28;

std::size_t hash_of(std::span<const std::uint8_t> bytes) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Larger files, except tiles, are sent directly from the file.
constexpr std::uint64_t kMostKept = 1 << 22;
constexpr const char* kList = "index.txt";

Response add_common(Response response) {
  response.headers.push_back({"Access-Control-Allow-Origin", "*"});
  response.headers.push_back({"Access-Control-Expose-Headers", "ETag, Content-Range, Accept-Ranges, X-Scarp-Bound"});
  response.headers.push_back({"X-Content-Type-Options", "nosniff"});
  return response;
}

bool is_tile(const TileSetReader& set, TileId id) {
  const auto& levels = set.tiles();
  const auto z = static_cast<std::size_t>(id.z);
  return z < levels.size() && std::ranges::binary_search(levels[z], std::uint64_t{id.y} << 32 | id.x);
}

Response answer_bytes(const Request& request, const std::string& name, std::vector<std::uint8_t> bytes) {
  Response response;
  const std::string_view type = media_type_of(name);
  const bool is_packed = io::is_gzip(bytes) && type != "application/gzip";
  const bool sends_packed = is_packed && accepts_gzip(request.header("accept-encoding"));
  const std::string tag = fmt::format("\"{:016x}{}\"", hash_of(bytes), is_packed && !sends_packed ? "-i" : "");
  response.headers.push_back({"ETag", tag});
  if (is_packed) response.headers.push_back({"Vary", "Accept-Encoding"});
  // A tile with a version in its URL never changes.
  const bool has_version = request.query.rfind("v=", 0) == 0 || request.query.find("&v=") != std::string::npos;
  response.headers.push_back({"Cache-Control", has_version ? "public, max-age=31536000, immutable" : "no-cache"});
  if (matches_tag(request.header("if-none-match"), tag)) {
    response.status = 304;
    return response;
  }
  response.headers.push_back({"Content-Type", std::string(type)});
  if (is_packed && !sends_packed) {
    auto whole = io::decompress_gzip(bytes, kMostUnpacked);
    if (!whole) return text_response(500, fmt::format("{} is damaged: {}", name, whole.error().message));
    bytes = std::move(*whole);
  }
  if (sends_packed) response.headers.push_back({"Content-Encoding", "gzip"});
  response.body = std::move(bytes);
  return response;
}

/// Answers with the file or a range of it.
Response answer_file(const Request& request, const std::string& name, const std::shared_ptr<const OpenFile>& file) {
  Response response;
  const FileStamp stamp = stamp_of(*file);
  const std::string tag = "\"" + stamp.text + "\"";
  response.headers = {{"ETag", tag},
                      {"Accept-Ranges", "bytes"},
                      {"Cache-Control", "no-cache"},
                      {"Content-Type", std::string(media_type_of(name))}};
  if (matches_tag(request.header("if-none-match"), tag)) {
    response.status = 304;
    return response;
  }
  ByteRange range{0, stamp.size - 1};
  const std::string if_range = request.header("if-range");
  const RangeKind kind =
      if_range.empty() || if_range == tag ? parse_range(request.header("range"), stamp.size, range) : RangeKind::kWhole;
  if (kind == RangeKind::kOutOfReach) {
    response = text_response(416, fmt::format("the file has {} bytes", stamp.size));
    response.headers.push_back({"Content-Range", fmt::format("bytes */{}", stamp.size)});
    return response;
  }
  if (kind == RangeKind::kPart) {
    response.status = 206;
    response.headers.push_back({"Content-Range", fmt::format("bytes {}-{}/{}", range.first, range.last, stamp.size)});
  }
  response.file = {file, range.first, range.last - range.first + 1};
  return response;
}

}  // namespace

TileAnswers::TileAnswers(std::unique_ptr<jobs::LiveTileSet> set, std::string name)
    : live_(set.get()), name_(std::move(name)) {
  set_ = std::make_unique<ServedSet>(std::move(set));
}

Result<std::unique_ptr<TileAnswers>> TileAnswers::open(const std::string& path) {
  SCARP_TRY(auto&& set, ServedSet::open(path));
  std::unique_ptr<TileAnswers> answers(new TileAnswers);
  answers->is_file_ = set->now()->file != nullptr;
  answers->set_ = std::move(set);
  std::string whole = path;
  while (whole.size() > 1 && whole.back() == '/') whole.pop_back();
  answers->name_ = base_name(whole);
  if (!answers->is_file_) answers->folder_ = whole;
  return answers;
}

Response TileAnswers::answer(const Request& request) const {
  if (request.method == "OPTIONS") {
    Response response;
    response.status = 204;
    response.headers = {{"Allow", "GET, HEAD, OPTIONS"},
                        {"Access-Control-Allow-Methods", "GET, HEAD, OPTIONS"},
                        {"Access-Control-Allow-Headers", "*"},
                        {"Access-Control-Max-Age", "86400"}};
    return add_common(std::move(response));
  }
  if (request.method != "GET" && request.method != "HEAD") {
    constexpr std::array kKnown{"POST", "PUT", "DELETE", "CONNECT", "TRACE", "PATCH"};
    const int status = std::ranges::count(kKnown, request.method) > 0 ? 405 : 501;
    Response response = text_response(status, "this server answers GET and HEAD");
    response.headers.push_back({"Allow", "GET, HEAD, OPTIONS"});
    return add_common(std::move(response));
  }
  return add_common(answer_path(request));
}

Response TileAnswers::answer_path(const Request& request) const {
  const std::string name = request.path.substr(1);
  Response response;
  if (!folder_.empty()) {
    response = answer_in_folder(request, name);
  } else {
    std::shared_ptr<const OpenedSet> opened = set_->now(), before;
    response = answer_in_set(request, name, *opened);
    before = std::exchange(opened, set_->now());
    if (response.status == 500 && opened != before) response = answer_in_set(request, name, *opened);
  }
  if (response.status != 404) return response;
  if (name.empty()) {
    const std::shared_ptr<const OpenedSet> opened = set_->now();
    return answer_bytes(request, "index.html", opened->page([&] { return make_page(*opened); }));
  }
  if (name == kList) return text_response(200, list_set(*set(), file_url()));
  return response;
}

std::vector<std::uint8_t> TileAnswers::make_page(const OpenedSet& opened) const {
  return make_set_page(name_, *opened.reader, live_ != nullptr);
}

Response TileAnswers::answer_missing(const std::string& name) const {
  if (find_tile_id(set()->format(), name))
    return text_response(
        404, fmt::format("this set has no tile {}: clients make it from its parent's, or it lies outside", name));
  return text_response(404, fmt::format("this set has no such file; its list is at /{}", kList));
}

Response TileAnswers::answer_in_folder(const Request& request, std::string name) const {
  if (name.empty() || name.back() == '/') name += "index.html";
  auto file = open_in_folder(folder_, name);
  // A set that is being replaced is deleted file by file.
  if (!file) file = open_in_folder(folder_, name);
  if (!file) return answer_missing(name);
  const bool is_any_tile = find_tile_id(TileFormat::kQuantizedMesh, name) || find_tile_id(TileFormat::kGlb, name);
  const bool is_large = stamp_of(*file).size > kMostKept || !request.header("range").empty();
  if (!is_any_tile && is_large) return answer_file(request, name, file);
  auto bytes = read_all(*file);
  if (!bytes) return text_response(500, bytes.error().message);
  return answer_bytes(request, name, std::move(*bytes));
}

Response TileAnswers::answer_in_set(const Request& request, const std::string& name, const OpenedSet& opened) const {
  // Only names of the set's files are searched, so no path leads out of the set.
  if (opened.file && name == name_) return answer_file(request, name, opened.file);
  const TileSetReader& set = *opened.reader;
  const auto id = find_tile_id(set.format(), name);
  const std::vector<std::string> files = id ? std::vector<std::string>() : set.files();
  if (id ? !is_tile(set, *id) : !std::ranges::binary_search(files, name)) return answer_missing(name);
  if (id && live_ != nullptr) {
    const auto tile = live_->make(*id);
    if (!tile) return text_response(500, tile.error().message);
    Response response = answer_bytes(request, name, (*tile)->bytes);
    const std::optional<double> bound = (*tile)->bound;
    response.headers.push_back({"X-Scarp-Bound", bound ? fmt::format("{:.4g}", *bound) : "estimated"});
    return response;
  }
  auto bytes = id ? set.read_tile(*id) : set.read_file(name);
  if (!bytes) return text_response(500, bytes.error().message);
  return answer_bytes(request, name, std::move(*bytes));
}

}  // namespace scarp::cli
