#include "jobs/plan_waters.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>

#include "io/base64.h"

namespace scarp::jobs {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little);

/// Limit of columns and rows.
constexpr double kFarthest = 0x1p40;

template <std::size_t N>
std::string pack(const std::vector<std::array<double, N>>& points) {
  return io::write_base64({reinterpret_cast<const std::uint8_t*>(points.data()), sizeof(points[0]) * points.size()});
}

template <std::size_t N>
std::vector<std::array<double, N>> unpack(const std::string& text) {
  std::span<const std::uint8_t> letters(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  const std::size_t count = text.size() / 4 * 3;
  std::vector<std::uint8_t> bytes;
  if (count < padding || !io::read_base64(letters, count - padding, bytes)) throw std::out_of_range("base64");
  std::vector<std::array<double, N>> points(bytes.size() / (N * sizeof(double)));
  if (points.size() * N * sizeof(double) != bytes.size() || points.empty()) throw std::out_of_range("points");
  std::memcpy(points.data(), bytes.data(), bytes.size());
  for (const auto& point : points) {
    if (!(std::abs(point[0]) < kFarthest) || !(std::abs(point[1]) < kFarthest)) throw std::out_of_range("place");
  }
  return points;
}

}  // namespace

Json describe_waters(const TileWaters& waters) {
  const DegreeBox& covered = waters.covered;
  Json json{{"covered", {covered.west, covered.south, covered.east, covered.north}}};
  json["lakes"] = Json::array();
  for (const tiles::TileLake& lake : waters.lakes) {
    Json rings = Json::array();
    for (const auto& ring : lake.rings) rings.push_back(pack(ring));
    const Json level = std::isnan(lake.level) ? Json(nullptr) : Json(lake.level);
    json["lakes"].push_back({{"name", lake.name}, {"level", level}, {"rings", std::move(rings)}});
  }
  json["rivers"] = Json::array();
  for (const tiles::TileRiver& river : waters.rivers)
    json["rivers"].push_back({{"name", river.name}, {"course", pack(river.course)}});
  return json;
}

TileWaters parse_waters(const Json& json) {
  TileWaters waters;
  const Json& covered = json.at("covered");
  waters.covered = {covered.at(0), covered.at(1), covered.at(2), covered.at(3)};
  for (const Json& one : json.at("lakes")) {
    tiles::TileLake lake;
    lake.name = one.at("name");
    lake.level = one.at("level").is_null() ? NAN : one.at("level").get<double>();
    for (const Json& ring : one.at("rings")) lake.rings.push_back(unpack<2>(ring));
    waters.lakes.push_back(std::move(lake));
  }
  for (const Json& one : json.at("rivers")) waters.rivers.push_back({one.at("name"), unpack<3>(one.at("course"))});
  return waters;
}

}  // namespace scarp::jobs
