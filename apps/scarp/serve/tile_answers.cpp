#include "serve/tile_answers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>

#include "scarp/gzip.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

/// More than any tile has.
constexpr std::size_t kMostUnpacked = std::size_t{1} << 28;

std::size_t hash_of(std::span<const std::uint8_t> bytes) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string media_type_of(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  if (ending == ".terrain") return "application/vnd.quantized-mesh";
  if (ending == ".glb") return "model/gltf-binary";
  if (ending == ".json") return "application/json";
  // A page that is kept beside the tiles.
  if (ending == ".html") return "text/html; charset=utf-8";
  if (ending == ".js") return "text/javascript; charset=utf-8";
  if (ending == ".css") return "text/css; charset=utf-8";
  return "application/octet-stream";
}

Response add_common(Response response) {
  response.headers.push_back({"Access-Control-Allow-Origin", "*"});
  response.headers.push_back({"Access-Control-Expose-Headers", "ETag, Content-Range, Accept-Ranges, X-Scarp-Bound"});
  response.headers.push_back({"X-Content-Type-Options", "nosniff"});
  return response;
}

}  // namespace

TileAnswers::OpenFile::OpenFile(OpenFile&& other) noexcept { *this = std::move(other); }
TileAnswers::OpenFile& TileAnswers::OpenFile::operator=(OpenFile&& other) noexcept {
  std::swap(fd, other.fd);
  std::swap(size, other.size);
  std::swap(tag, other.tag);
  return *this;
}
TileAnswers::OpenFile::~OpenFile() {
  if (fd >= 0) ::close(fd);
}

TileAnswers::~TileAnswers() = default;

TileAnswers::TileAnswers(std::unique_ptr<LiveTileSet> set) : live_(set.get()) { reader_ = std::move(set); }

Result<TileAnswers> TileAnswers::open(const std::string& path) {
  TileAnswers answers;
  auto reader = open_tile_set(path);
  if (!reader) return tl::unexpected(reader.error());
  answers.reader_ = std::move(*reader);
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return answers;
  struct stat status {};
  answers.file_.fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (answers.file_.fd < 0 || ::fstat(answers.file_.fd, &status) != 0)
    return fail(ErrorKind::kInput, fmt::format("cannot read {}", path));
  answers.name_ = base_name(path);
  answers.file_.size = static_cast<std::uint64_t>(status.st_size);
  answers.file_.tag =
      fmt::format("\"{:x}-{:x}-{:x}\"", answers.file_.size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
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
    Response response = text_response(405, "this server answers GET and HEAD");
    response.headers.push_back({"Allow", "GET, HEAD, OPTIONS"});
    return add_common(std::move(response));
  }
  if (request.path == "/") return add_common(answer_root());
  if (!name_.empty() && request.path == file_url()) return add_common(answer_file(request));
  const std::string name = request.path.substr(1);
  const auto id = find_tile_id(reader_->format(), name);
  // Names are looked up among those of the set, so that no path leads out of it.
  bool is_there = false;
  if (id) {
    const auto& levels = reader_->tiles();
    const auto z = static_cast<std::size_t>(id->z);
    is_there =
        z < levels.size() && std::binary_search(levels[z].begin(), levels[z].end(), std::uint64_t{id->y} << 32 | id->x);
    if (!is_there)
      return add_common(text_response(
          404, fmt::format("this set has no tile {}: clients make it from its parent's, or it lies outside", name)));
  } else {
    const std::vector<std::string> files = reader_->files();
    is_there = std::binary_search(files.begin(), files.end(), name);
    if (!is_there) return add_common(text_response(404, "this set has no such file; its list is at /"));
  }
  if (id && live_ != nullptr) return add_common(answer_live(request, name, *id));
  auto bytes = id ? reader_->read_tile(*id) : reader_->read_file(name);
  if (!bytes) return add_common(text_response(500, bytes.error().message));
  return add_common(answer_kept(request, name, std::move(*bytes)));
}

Response TileAnswers::answer_root() const {
  std::string text = "scarp serve\n";
  for (const std::string& name : reader_->files()) {
    if (name.rfind("subtrees/", 0) != 0) text += "/" + name + "\n";
  }
  text += reader_->format() == TileFormat::kGlb ? "/{root}/{z}/{x}/{y}.glb\n" : "/{z}/{x}/{y}.terrain\n";
  text += file_url();
  return text_response(200, text);
}

Response TileAnswers::answer_live(const Request& request, const std::string& name, TileId id) const {
  const auto tile = live_->make(id);
  if (!tile) return text_response(500, tile.error().message);
  Response response = answer_kept(request, name, (*tile)->bytes);
  const std::optional<double> bound = (*tile)->bound;
  response.headers.push_back({"X-Scarp-Bound", bound ? fmt::format("{:.4g}", *bound) : "estimated"});
  return response;
}

Response TileAnswers::answer_kept(const Request& request, const std::string& name,
                                  std::vector<std::uint8_t> bytes) const {
  Response response;
  const bool is_packed = is_gzip(bytes), sends_packed = is_packed && accepts_gzip(request.header("accept-encoding"));
  const std::string tag = fmt::format("\"{:016x}{}\"", hash_of(bytes), is_packed && !sends_packed ? "-i" : "");
  response.headers.push_back({"ETag", tag});
  if (is_packed) response.headers.push_back({"Vary", "Accept-Encoding"});
  // With a version in its URL a tile never changes.
  const bool has_version = request.query.rfind("v=", 0) == 0 || request.query.find("&v=") != std::string::npos;
  response.headers.push_back({"Cache-Control", has_version ? "public, max-age=31536000, immutable" : "no-cache"});
  if (matches_tag(request.header("if-none-match"), tag)) {
    response.status = 304;
    return response;
  }
  response.headers.push_back({"Content-Type", media_type_of(name)});
  if (is_packed && !sends_packed) {
    auto whole = decompress_gzip(bytes, kMostUnpacked);
    if (!whole) return text_response(500, fmt::format("{} is damaged: {}", name, whole.error().message));
    bytes = std::move(*whole);
  }
  if (sends_packed) response.headers.push_back({"Content-Encoding", "gzip"});
  response.body = std::move(bytes);
  return response;
}

Response TileAnswers::answer_file(const Request& request) const {
  Response response;
  response.headers = {{"ETag", file_.tag},
                      {"Accept-Ranges", "bytes"},
                      {"Cache-Control", "no-cache"},
                      {"Content-Type", "application/octet-stream"}};
  if (matches_tag(request.header("if-none-match"), file_.tag)) {
    response.status = 304;
    return response;
  }
  ByteRange range{0, file_.size - 1};
  const std::string if_range = request.header("if-range");
  const RangeKind kind = if_range.empty() || if_range == file_.tag
                             ? parse_range(request.header("range"), file_.size, range)
                             : RangeKind::kWhole;
  if (kind == RangeKind::kOutOfReach) {
    response = text_response(416, fmt::format("the file has {} bytes", file_.size));
    response.headers.push_back({"Content-Range", fmt::format("bytes */{}", file_.size)});
    return response;
  }
  if (kind == RangeKind::kPart) {
    response.status = 206;
    response.headers.push_back({"Content-Range", fmt::format("bytes {}-{}/{}", range.first, range.last, file_.size)});
  }
  response.file = {file_.fd, range.first, range.last - range.first + 1};
  return response;
}

}  // namespace scarp::cli
