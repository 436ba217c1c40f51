// The answers of a server from a set of tiles, finished or not.
#pragma once

#include <memory>
#include <string>

#include "jobs/live_tiles.h"
#include "scarp/tile_set.h"
#include "serve/http_message.h"
#include "serve/served_set.h"

namespace scarp::cli {

class TileAnswers {
 public:
  /// Fails as open_tile_set() does. A set that replaces it is served from then on, and so are files that are put into a
  /// folder.
  static Result<std::unique_ptr<TileAnswers>> open(const std::string& path);
  /// Answers from tiles that are made when they are asked for. `name` is the name of the set.
  TileAnswers(std::unique_ptr<LiveTileSet> set, std::string name);

  /// The set as it is now.
  std::shared_ptr<const TileSetReader> set() const { return set_->now()->reader; }
  /// Several threads may call it at once.
  Response answer(const Request& request) const;

 private:
  TileAnswers() = default;
  Response answer_path(const Request& request) const;
  Response answer_missing(const std::string& name) const;
  /// Both return status 404 for what is not there.
  Response answer_in_folder(const Request& request, std::string name) const;
  Response answer_in_set(const Request& request, const std::string& name, const OpenedSet& opened) const;
  std::vector<std::uint8_t> make_page(const OpenedSet& opened) const;
  /// The URL's path of the set itself, where it is one file; else empty.
  std::string file_url() const { return is_file_ ? "/" + name_ : ""; }

  std::unique_ptr<ServedSet> set_;
  const LiveTileSet* live_ = nullptr;  ///< the same, where it makes its tiles
  std::string name_, folder_;          ///< the folder is empty where the set is none
  bool is_file_ = false;
};

}  // namespace scarp::cli
