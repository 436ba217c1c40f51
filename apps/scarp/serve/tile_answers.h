// Answers of a server, from a finished tileset or from tiles made on demand.
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
  /// Fails if open_tile_set() fails. If another set later replaces this one, serves the new set; also serves new files
  /// in its folder.
  static Result<std::unique_ptr<TileAnswers>> open(const std::string& path);
  /// Answers with tiles made on demand. `name`: the set's name.
  TileAnswers(std::unique_ptr<jobs::LiveTileSet> set, std::string name);

  /// The current set.
  std::shared_ptr<const TileSetReader> set() const { return set_->now()->reader; }
  /// May be called concurrently.
  Response answer(const Request& request) const;

 private:
  TileAnswers() = default;
  Response answer_path(const Request& request) const;
  Response answer_missing(const std::string& name) const;
  /// These two return status 404 for missing files.
  Response answer_in_folder(const Request& request, std::string name) const;
  Response answer_in_set(const Request& request, const std::string& name, const OpenedSet& opened) const;
  std::vector<std::uint8_t> make_page(const OpenedSet& opened) const;
  /// The URL path of a single-file set; else empty.
  std::string file_url() const { return is_file_ ? "/" + name_ : ""; }

  std::unique_ptr<ServedSet> set_;
  const jobs::LiveTileSet* live_ = nullptr;  ///< the set, if it makes tiles on demand
  std::string name_, folder_;                ///< the folder is empty if the set has none
  bool is_file_ = false;
};

}  // namespace scarp::cli
