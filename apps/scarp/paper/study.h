// Common parts of the experiments: the fields, the page that they write on, and one run of the engine.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "paper/fields.h"
#include "paper/figures.h"
#include "paper/page.h"
#include "paper/plot.h"
#include "scarp/io.h"
#include "scarp/paper.h"
#include "scarp/result.h"

namespace scarp::paper {

/// The results of a run that a table needs.
struct Trial {
  std::uint64_t vertices = 0, triangles = 0;
  double max_error = 0, rmse = 0;
  double thin_share = 0;  ///< percent of triangles with an angle below 5 degrees, seen from above
  Work work;
};

class Study {
 public:
  Study(Fields fields, std::string folder, bool timing, bool quiet);

  Page page;
  const Fields fields;
  const std::string folder;
  const bool timing;

  /// A line on stderr, unless quiet.
  void note(const std::string& what) const;
  /// The field called `key`; null if it is not there.
  const Field* find(const std::string& key) const;
  /// Those of the paper's fields that are named, else all.
  template <std::size_t N>
  std::vector<const Field*> choose(const std::array<const char*, N>& keys) const {
    std::vector<const Field*> chosen;
    for (const Field& field : fields.all) {
      if (!fields.are_of_paper || position_of(keys, field.key) >= 0) chosen.push_back(&field);
    }
    return chosen;
  }

  /// simplify_by_paper(), which Ctrl-C ends; its complaints begin with `name`.
  Result<Simplified> run(const HeightField& field, const std::string& name, PaperOptions options) const;
  /// The same of simplify(), for what the paper has not.
  Result<Simplified> run_by_effort(const HeightField& field, const std::string& name, SimplifyOptions options) const;
  /// Greedy insertion up to exactly `vertices` vertices.
  Result<Trial> refine(const Field& field, std::uint64_t vertices, PaperOptions options = {}) const;
  /// The same towards the goals in `options`.
  Result<Trial> reach(const Field& field, PaperOptions options) const;
  /// CPU seconds of greedy insertion up to that many vertices on one thread, without reading and judging.
  Result<double> time(const Field& field, std::uint64_t vertices, PaperOptions options = {}) const;
  /// refine() with Delaunay edges and nothing else chosen; runs once for each field and number.
  Result<Trial> delaunay(const Field& field, std::uint64_t vertices);

  /// Adds a picture below the page's images folder, and to the page.
  Result<void> add_picture(const std::string& name, const std::string& caption, std::vector<std::uint8_t> png);
  Result<void> add_plot(const std::string& name, const Plot& plot);

  struct File {
    std::string path;  ///< relative to the page
    std::vector<std::uint8_t> bytes;
  };
  const std::vector<File>& pictures() const { return pictures_; }

 private:
  bool quiet_;
  std::map<std::pair<std::string, std::uint64_t>, Trial> delaunay_;
  std::vector<File> pictures_;
};

/// Options for exactly that many vertices.
PaperOptions exactly(std::uint64_t vertices, PaperOptions options = {});
/// Data-dependent triangulation as the paper's program does it: edges are not settled after the last insertion.
EdgeRule scape_edges(EdgeScore score, double shape_threshold);
/// A rule for the options.
PaperOptions with_edges(const EdgeRule& edges);

/// `cols` × `rows` samples spread evenly, borders included, for a field of that shape and about `vertices` of them.
struct UniformGrid {
  std::vector<SampleAt> steps;
  int cols = 0, rows = 0;
  std::uint64_t vertices() const { return steps.size(); }
};
UniformGrid uniform_grid(int field_cols, int field_rows, std::uint64_t vertices);

/// A figure of the paper's program for a field, if there is one.
template <std::size_t N, class Figures>
std::optional<double> figure_of(const Study& study, const std::array<const char*, N>& keys, const Figures& figures,
                                const Field& field) {
  const int at = study.fields.are_of_paper ? position_of(keys, field.key) : -1;
  if (at < 0) return std::nullopt;
  return static_cast<double>(figures[static_cast<std::size_t>(at)]);
}

/// Percent from Scape's figure at which a sentence next to the table explains why.
inline constexpr double kFarPercent = 45;

// The experiments, each a section of the page.
Result<void> add_illustration(Study& study);
Result<void> add_memory(Study& study);
Result<void> add_selectors(Study& study);
Result<void> add_effort(Study& study);
Result<void> add_algorithms(Study& study);
Result<void> add_batches(Study& study);
Result<void> add_edge_rules(Study& study);
Result<void> add_edge_sweep(Study& study);
Result<void> add_supersampling(Study& study);
Result<void> add_settling(Study& study);
Result<void> add_surfaces(Study& study);
Result<void> add_synthetic(Study& study);
Result<void> add_reference_rows(Study& study);
Result<void> add_cross_checks(Study& study);
Result<void> add_error_curves(Study& study);
Result<void> add_edge_curves(Study& study);
Result<void> add_seconds(Study& study);
Result<void> add_textured_terrain(Study& study);
Result<void> add_images(Study& study);

}  // namespace scarp::paper
