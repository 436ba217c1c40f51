// Stores a tile job as a file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/fnv.h"
#include "io/commands.h"
#include "io/tiles/byte_source.h"
#include "io/tiles/grid_json.h"
#include "jobs/plan_waters.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/version.h"
#include "tiles/mesh/tile_lines.h"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPlanVersion = 1;
/// Range of longitudes of lines.
constexpr double kMostDegrees = 720;
constexpr std::pair<Effort, const char*> kEfforts[] = {
    {Effort::kFast, "fast"}, {Effort::kNormal, "normal"}, {Effort::kHigh, "high"}};
constexpr std::pair<Decode, const char*> kDecodes[] = {
    {Decode::kNone, "none"}, {Decode::kTerrarium, "terrarium"}, {Decode::kMapbox, "mapbox"}};
constexpr std::pair<Vertical, const char*> kVerticals[] = {
    {Vertical::kAuto, "auto"}, {Vertical::kEllipsoid, "ellipsoid"}, {Vertical::kEgm96, "egm96"},
    {Vertical::kEpsg, "epsg"}, {Vertical::kGeoid, "geoid"},         {Vertical::kNone, "none"}};
constexpr std::pair<TileFormat, const char*> kFormats[] = {{TileFormat::kQuantizedMesh, "quantized-mesh"},
                                                           {TileFormat::kGlb, "glb"}};

constexpr std::pair<ImageFormat, const char*> kImageFormats[] = {
    {ImageFormat::kJpeg, "jpeg"}, {ImageFormat::kPng, "png"}, {ImageFormat::kWebp, "webp"}};

template <class T, std::size_t N>
const char* word_of(T value, const std::pair<T, const char*> (&words)[N]) {
  for (const auto& [one, word] : words) {
    if (one == value) return word;
  }
  return "";
}

/// Throws std::out_of_range for an unknown word.
template <class T, std::size_t N>
T value_of(const std::string& word, const std::pair<T, const char*> (&words)[N]) {
  for (const auto& [one, name] : words) {
    if (word == name) return one;
  }
  throw std::out_of_range(word);
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class T>
std::optional<T> optional_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<T>());
}

Json describe_reading(const ReadOptions& reading) {
  Json json{{"band", reading.band},
            {"nodata", or_null(reading.nodata)},
            {"decode", word_of(reading.decode, kDecodes)},
            {"z_scale", reading.z_scale},
            {"z_offset", reading.z_offset},
            {"fill_distance", reading.fill_distance},
            {"extent", or_null(reading.view.extent)},
            {"resolution", or_null(reading.view.resolution)}};
  if (reading.cell_size) json["cell_size"] = *reading.cell_size;
  if (reading.void_side > 0) json["void_side"] = reading.void_side;
  if (!reading.z_unit.empty()) json["z_unit"] = reading.z_unit;
  return json;
}

Json describe_box(const DegreeBox& box) { return {box.west, box.south, box.east, box.north}; }

DegreeBox parse_box(const Json& json) { return {json.at(0), json.at(1), json.at(2), json.at(3)}; }

Json describe_plan(const PyramidPlan& plan) {
  Json levels = Json::array();
  for (const PyramidLevel& level : plan.levels) {
    levels.push_back({{"geometric_error", level.geometric_error},
                      {"max_error", level.max_error},
                      {"quantum", level.quantum},
                      {"segments", level.segments}});
  }
  Json sources = Json::array();
  for (const PlannedSource& source : plan.sources)
    sources.push_back({{"covered", describe_box(source.covered)}, {"max_zoom", source.max_zoom}});
  Json json{{"cells", plan.cells},
            {"block_level", plan.block_level},
            {"effort", word_of(plan.effort, kEfforts)},
            {"background", plan.background},
            {"has_siblings", plan.has_siblings},
            {"ellipsoid", {plan.ellipsoid.semi_major, plan.ellipsoid.inverse_flattening}},
            {"grid", io::describe_grid(plan.grid)},
            {"covered", describe_box(plan.covered)},
            {"sources", std::move(sources)},
            {"levels", std::move(levels)}};
  if (plan.has_water_mask) json["has_water_mask"] = true;
  if (plan.waters) json["waters"] = jobs::describe_waters(*plan.waters);
  if (plan.max_tile_bytes > 0) json["max_tile_bytes"] = plan.max_tile_bytes;
  if (plan.binds_samples) json["binds_samples"] = true;
  if (plan.lines) json["lines"] = plan.lines->lines();
  return json;
}

Json describe_stamp(const FileStamp& file) {
  Json stamp{{"path", file.path}, {"size", file.size}, {"changed", file.changed}};
  if (file.content != 0) stamp["content"] = file.content;
  return stamp;
}

FileStamp parse_stamp(const Json& json) {
  return {json.at("path"), json.at("size"), json.at("changed"), json.value("content", std::uint64_t{0})};
}

Json describe_datum(const TileJob& job) {
  const Datum& datum = job.datum;
  Json json{{"vertical", word_of(datum.vertical, kVerticals)}};
  if (datum.vertical == Vertical::kEpsg) json["epsg"] = datum.epsg;
  if (datum.vertical == Vertical::kGeoid) json["geoid"] = describe_stamp(job.geoid);
  if (datum.ellipsoid) json["ellipsoid"] = {datum.ellipsoid->semi_major, datum.ellipsoid->inverse_flattening};
  return json;
}

void parse_datum(const Json& json, TileJob& job) {
  Datum& datum = job.datum;
  datum.vertical = value_of(json.at("vertical"), kVerticals);
  if (datum.vertical == Vertical::kEpsg) datum.epsg = json.at("epsg");
  if (datum.vertical == Vertical::kGeoid) {
    job.geoid = parse_stamp(json.at("geoid"));
    datum.geoid = job.geoid.path;
  }
  if (!json.contains("ellipsoid")) return;
  datum.ellipsoid.emplace();
  datum.ellipsoid->semi_major = json["ellipsoid"].at(0);
  datum.ellipsoid->inverse_flattening = json["ellipsoid"].at(1);
}

Json describe_plane(const PlaneOnGlobe& plane) {
  return {{"transform", plane.transform},     {"crs", plane.crs},
          {"convergence", plane.convergence}, {"scale", {plane.scale_x, plane.scale_y}},
          {"off_along", plane.off_along},     {"off_height", plane.off_height}};
}

PlaneOnGlobe parse_plane(const Json& json) {
  return {json.at("transform").get<std::array<double, 16>>(),
          json.at("crs"),
          json.at("convergence"),
          json.at("scale").at(0),
          json.at("scale").at(1),
          json.at("off_along"),
          json.at("off_height")};
}

Json describe_drape(const TileDrape& drape) {
  Json files = Json::array();
  for (const FileStamp& file : drape.files) files.push_back(describe_stamp(file));
  return {{"files", std::move(files)}, {"format", word_of(drape.format, kImageFormats)}};
}

/// True if plan_pyramid() could have made the plan.
bool is_sound(const PyramidPlan& plan) {
  if (plan.levels.empty() || plan.max_zoom() > kMaxTileLevel || plan.block_level < 0 ||
      plan.block_level > plan.max_zoom() || plan.max_zoom() - plan.block_level > 8 || plan.cells < 16 ||
      plan.cells > 256 || (plan.cells & (plan.cells - 1)) != 0)
    return false;
  if (plan.grid.is_flat() && plan.grid.local.side != std::int64_t{plan.cells} << plan.max_zoom()) return false;
  return std::all_of(plan.levels.begin(), plan.levels.end(), [](const PyramidLevel& level) {
    return level.max_error > 0 && level.quantum > 0 && level.segments >= 1 && level.segments <= 256 &&
           (level.segments & (level.segments - 1)) == 0;
  });
}

/// Throws std::out_of_range for invalid positions.
void add_lines(std::vector<DegreeLine> lines, PyramidPlan& plan) {
  for (const DegreeLine& line : lines) {
    for (const auto& [longitude, latitude] : line) {
      if (!(std::abs(longitude) <= kMostDegrees) || !(std::abs(latitude) <= 90)) throw std::out_of_range("lines");
    }
  }
  if (!is_sound(plan)) throw std::out_of_range("levels");
  set_lines(plan, std::move(lines));
}

PyramidPlan parse_plan(const Json& json) {
  PyramidPlan plan;
  plan.cells = json.at("cells");
  plan.block_level = json.at("block_level");
  plan.effort = value_of(json.at("effort"), kEfforts);
  plan.background = json.at("background");
  plan.has_siblings = json.at("has_siblings");
  plan.max_tile_bytes = json.value("max_tile_bytes", std::uint64_t{0});
  plan.binds_samples = json.value("binds_samples", false);
  plan.ellipsoid.semi_major = json.at("ellipsoid").at(0);
  plan.ellipsoid.inverse_flattening = json.at("ellipsoid").at(1);
  plan.grid = io::parse_grid(json.at("grid")).value();
  plan.covered = parse_box(json.at("covered"));
  for (const Json& source : json.at("sources"))
    plan.sources.push_back({parse_box(source.at("covered")), source.at("max_zoom")});
  for (const Json& level : json.at("levels"))
    plan.levels.push_back(
        {level.at("geometric_error"), level.at("max_error"), level.at("quantum"), level.at("segments")});
  plan.has_water_mask = json.value("has_water_mask", false);
  if (json.contains("waters")) {
    TileWaters waters = jobs::parse_waters(json["waters"]);
    waters.grid = plan.grid;
    waters.per_turn = plan.grid.per_turn(plan.max_zoom(), plan.cells);
    plan.waters = std::make_shared<const TileWaters>(std::move(waters));
  }
  if (json.contains("lines")) add_lines(json["lines"].get<std::vector<DegreeLine>>(), plan);
  return plan;
}

Json describe_stamps(const std::vector<FileStamp>& files) {
  Json stamps = Json::array();
  for (const FileStamp& file : files) stamps.push_back(describe_stamp(file));
  return stamps;
}

std::vector<FileStamp> parse_stamps(const Json& json) {
  std::vector<FileStamp> files;
  for (const Json& file : json) files.push_back(parse_stamp(file));
  return files;
}

TileJob parse_job(const Json& json) {
  TileJob job;
  job.rasters = parse_stamps(json.at("rasters"));
  job.mosaics = json.at("mosaics").get<std::vector<std::uint32_t>>();
  job.files = parse_stamps(json.at("files"));
  const Json& reading = json.at("reading");
  job.reading.band = reading.at("band");
  job.reading.nodata = optional_of<double>(reading.at("nodata"));
  job.reading.decode = value_of(reading.at("decode"), kDecodes);
  job.reading.z_scale = reading.at("z_scale");
  job.reading.z_offset = reading.at("z_offset");
  job.reading.fill_distance = reading.at("fill_distance");
  job.reading.view.extent = optional_of<std::array<double, 4>>(reading.at("extent"));
  job.reading.view.resolution = optional_of<double>(reading.at("resolution"));
  job.reading.void_side = reading.value("void_side", 0);
  job.reading.z_unit = reading.value("z_unit", "");
  if (reading.contains("cell_size")) job.reading.cell_size = reading["cell_size"].get<double>();
  parse_datum(json.at("datum"), job);
  if (json.contains("waters")) {
    const Json& waters = json["waters"];
    job.waters = {waters.at("lakes").get<std::vector<std::string>>(),
                  waters.at("rivers").get<std::vector<std::string>>(), waters.at("percentile")};
  }
  job.format = value_of(json.at("format"), kFormats);
  if (json.contains("drape"))
    job.drape = {parse_stamps(json["drape"].at("files")), value_of(json["drape"].at("format"), kImageFormats)};
  job.facts.name = json.at("name");
  job.facts.description = json.at("description");
  job.facts.attribution = json.at("attribution");
  job.facts.heights_above = json.at("heights_above");
  job.facts.vertical = json.value("vertical", "");
  job.facts.body = json.at("body");
  job.facts.units = json.value("units", "");
  if (json.contains("plane")) job.facts.plane = parse_plane(json["plane"]);
  job.parts = json.value("parts", "");
  job.filled = json.value("filled", std::uint64_t{0});
  job.costs = json.value("costs", std::vector<std::uint32_t>());
  if (json.contains("estimate")) {
    const Json& estimate = json["estimate"];
    job.estimate = {estimate.at("blocks"), estimate.at("finest_tiles"), estimate.at("tiles"),
                    estimate.at("bytes"),  estimate.at("core_seconds"), estimate.at("memory"),
                    estimate.at("parts")};
  }
  job.plan = parse_plan(json.at("pyramid"));
  return job;
}

/// True if each raster is in exactly one mosaic.
bool has_sound_mosaics(const TileJob& job) {
  std::uint64_t rasters = 0;
  for (const std::uint32_t count : job.mosaics) {
    if (count == 0) return false;
    rasters += count;
  }
  return rasters > 0 && rasters == job.rasters.size();
}

Json describe_job(const TileJob& job) {
  Json json{{"scarp_tile_plan", kPlanVersion},
            {"generator", std::string("scarp ") + version()},
            {"rasters", describe_stamps(job.rasters)},
            {"mosaics", job.mosaics},
            {"files", describe_stamps(job.files)},
            {"reading", describe_reading(job.reading)},
            {"datum", describe_datum(job)},
            {"heights_above", job.facts.heights_above},
            {"body", job.facts.body},
            {"format", word_of(job.format, kFormats)},
            {"name", job.facts.name},
            {"description", job.facts.description},
            {"attribution", job.facts.attribution},
            {"pyramid", describe_plan(job.plan)}};
  if (!job.facts.vertical.empty()) json["vertical"] = job.facts.vertical;
  if (job.filled > 0) json["filled"] = job.filled;
  if (!job.facts.units.empty()) json["units"] = job.facts.units;
  if (job.facts.plane) json["plane"] = describe_plane(*job.facts.plane);
  if (!job.waters.is_empty())
    json["waters"] = {
        {"lakes", job.waters.lakes}, {"rivers", job.waters.rivers}, {"percentile", job.waters.percentile}};
  if (job.drape) json["drape"] = describe_drape(*job.drape);
  if (!job.parts.empty()) json["parts"] = job.parts;
  if (!job.costs.empty()) json["costs"] = job.costs;
  if (job.estimate) {
    const TileEstimate& estimate = *job.estimate;
    json["estimate"] = {
        {"blocks", estimate.blocks}, {"finest_tiles", estimate.finest_tiles}, {"tiles", estimate.tiles},
        {"bytes", estimate.bytes},   {"core_seconds", estimate.core_seconds}, {"memory", estimate.memory},
        {"parts", estimate.parts}};
  }
  return json;
}

/// Describes files by their content if known, else by their stamps.
Json describe_contents(const std::vector<FileStamp>& files) {
  Json stamps = Json::array();
  for (const FileStamp& file : files) {
    if (file.content != 0)
      stamps.push_back(file.content);
    else
      stamps.push_back(describe_stamp(file));
  }
  return stamps;
}

std::uint64_t hash_of(const Json& json) {
  const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace);
  Fnv name;
  name.add(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  return name.hash();
}

}  // namespace

std::vector<std::uint8_t> encode_tile_job(const TileJob& job) {
  const std::string text = describe_job(job).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  return {text.begin(), text.end()};
}

Result<TileJob> decode_tile_job(std::span<const std::uint8_t> bytes, const std::string& name_for_errors) {
  try {
    const Json json = Json::parse(bytes.begin(), bytes.end());
    if (json.at("scarp_tile_plan") == kPlanVersion) {
      TileJob job = parse_job(json);
      const bool has_sound_drape = !job.drape || !job.drape->files.empty();
      if (is_sound(job.plan) && has_sound_mosaics(job) && has_sound_drape) return job;
    }
  } catch (const std::exception&) {
    // Reported below.
  }
  return fail(ErrorKind::kInput,
              fmt::format("{} is no plan of tiles of this version: make one first (scarp tile plan RASTER {})",
                          name_for_errors, io::new_file(".json")));
}

Result<TileJob> read_tile_job(const std::string& path) {
  SCARP_TRY(const auto& source, io::ByteSource::open(path));
  SCARP_TRY(const auto& bytes, source->read(0, source->size()));
  return decode_tile_job(bytes, path);
}

std::uint64_t key_of(const TileJob& job) {
  Json json = describe_job(job);
  for (const char* other : {"estimate", "costs", "filled"}) json.erase(other);
  return hash_of(json);
}

std::uint64_t settings_key_of(const TileJob& job) {
  Json json = describe_job(job);
  for (const char* other : {"estimate", "costs", "rasters", "files", "waters", "parts", "heights_above", "body", "name",
                            "description", "attribution", "units", "plane", "filled"})
    json.erase(other);
  json["datum"].erase("geoid");
  json["pyramid"].erase("covered");
  json["pyramid"].erase("waters");
  // Blocks with an outdated texture are not reused.
  if (job.drape) json["drape"]["files"] = describe_contents(job.drape->files);
  return hash_of(json);
}

std::uint64_t sources_key_of(const TileJob& job) {
  std::vector<FileStamp> files = job.rasters;
  files.insert(files.end(), job.files.begin(), job.files.end());
  if (job.datum.vertical == Vertical::kGeoid) files.push_back(job.geoid);
  Json stamps = describe_contents(files);
  if (job.plan.waters) stamps.push_back(hash_of(jobs::describe_waters(*job.plan.waters)));
  return hash_of(stamps);
}

}  // namespace scarp
