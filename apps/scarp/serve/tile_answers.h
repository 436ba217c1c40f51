// What a server answers from a set of tiles, finished or not.
#pragma once

#include <memory>
#include <string>

#include "scarp/live_tiles.h"
#include "scarp/tile_set.h"
#include "serve/http_message.h"

namespace scarp::cli {

class TileAnswers {
 public:
  /// Fails as open_tile_set() does.
  static Result<TileAnswers> open(const std::string& path);
  /// Of tiles that are made when they are asked for.
  explicit TileAnswers(std::unique_ptr<LiveTileSet> set);
  TileAnswers(TileAnswers&&) = default;
  TileAnswers& operator=(TileAnswers&&) = default;
  ~TileAnswers();

  const TileSetReader& set() const { return *reader_; }
  /// The URL's path of the set itself, where it is one file; else empty.
  std::string file_url() const { return name_.empty() ? "" : "/" + name_; }
  /// Several threads may call it at once.
  Response answer(const Request& request) const;

 private:
  struct OpenFile {
    int fd = -1;
    std::uint64_t size = 0;
    std::string tag;
    OpenFile() = default;
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&& other) noexcept;
    ~OpenFile();
  };

  TileAnswers() = default;
  Response answer_root() const;
  Response answer_live(const Request& request, const std::string& name, TileId id) const;
  Response answer_kept(const Request& request, const std::string& name, std::vector<std::uint8_t> bytes) const;
  Response answer_file(const Request& request) const;

  std::unique_ptr<TileSetReader> reader_;
  const LiveTileSet* live_ = nullptr;  ///< the same, where it makes its tiles
  std::string name_;                   ///< of the set, where it is one file
  OpenFile file_;
};

}  // namespace scarp::cli
