// The tables of bench/quality whose rows are meshes judged by measure(). Each table has a source that defines a Suite;
// quality.cpp runs them.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "../harness.h"
#include "scarp/scarp.h"

namespace bench {

/// The rows of one raster, and the times of its variants.
class Rows {
 public:
  Rows(std::filesystem::path of_project, const char* header)
      : project(std::move(of_project)), table_(std::string(header) + "\n") {}

  const std::filesystem::path project;

  /// Adds a row, given without line end, and prints it.
  void add(const std::string& row);
  /// Adds to the mean ratio of a variant's CPU time to greedy insertion's.
  void add_time(std::string_view variant, double ratio);
  const std::string& table() const { return table_; }
  const std::map<std::string, std::vector<double>>& times() const { return times_; }

 private:
  std::string table_;
  std::map<std::string, std::vector<double>> times_;
};

struct Suite {
  const char* name;    ///< bench/quality/NAME.csv
  const char* header;  ///< names of columns; the first is the raster's
  std::vector<std::string> (*names)(const std::filesystem::path& project);
  void (*measure)(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows);
  /// Reads a raster by name; null: one of find_raster() or a style of `scarp generate`.
  scarp::Result<scarp::OwnedHeightField> (*read)(const std::filesystem::path& project,
                                                 const std::string& name) = nullptr;
};

/// The names in PROJECT/bench/quality/LIST.txt.
template <const char* kList>
std::vector<std::string> names_in(const std::filesystem::path& project) {
  return read_names(project / "bench/quality" / (std::string(kList) + ".txt"));
}

scarp::Result<scarp::OwnedHeightField> read_field(const std::filesystem::path& project, const std::string& name,
                                                  int generated_side = 768);

/// A mesh judged by measure(), and its cost.
struct Made {
  scarp::Measurement judged;
  double seconds = 0;       ///< CPU time of simplify()
  double thin_percent = 0;  ///< share of triangles with an angle below 5 degrees, seen from above
};

/// Exits with 3 if the mesh exceeds its max error or budget, does not cover a sample, or is not sound.
Made make(const std::string& what, const scarp::OwnedHeightField& field, const scarp::SimplifyOptions& options);

inline double relief_of(const scarp::OwnedHeightField& field) { return field.info.max - field.info.min; }

extern const Suite kEfforts, kBudgets, kHighNormal, kEdges, kOptimum, kOrders, kRidges, kPictures;

}  // namespace bench
