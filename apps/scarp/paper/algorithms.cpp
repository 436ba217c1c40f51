// Section 4: Algorithms I, II and III make the same meshes and differ in what they scan.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/study.h"

namespace scarp::paper {
namespace {

constexpr std::array kSmallFields{"crater", "ashby", "ozark"};
constexpr std::array kAlgorithms{Algorithm::kBruteForce, Algorithm::kLocal, Algorithm::kHeap};
constexpr std::array kNames{"I", "II", "III"};

struct Runs {
  std::array<Work, 3> works;
  bool same = true;  ///< meshes, to the last bit
};

Result<Runs> run(const Study& study, const Field& field, std::uint64_t vertices) {
  Runs runs;
  Mesh first;
  for (std::size_t k = 0; k < kAlgorithms.size(); ++k) {
    PaperOptions options;
    options.strategy.algorithm = kAlgorithms[k];
    SCARP_TRY(const Simplified& result, study.run(field.heights, field.file, exactly(vertices, options)));
    runs.works[k] = result.work;
    if (k == 0) first = result.mesh;
    runs.same = runs.same && result.mesh.positions == first.positions && result.mesh.triangles == first.triangles;
  }
  return runs;
}

/// CPU seconds, the least of three runs each.
Result<std::array<double, 3>> time_all(const Study& study, const Field& field, std::uint64_t vertices) {
  std::array<double, 3> least{};
  for (int round = 0; round < 3; ++round) {
    for (std::size_t k = 0; k < kAlgorithms.size(); ++k) {
      PaperOptions options;
      options.strategy.algorithm = kAlgorithms[k];
      SCARP_TRY(const double seconds, study.time(field, vertices, options));
      least[k] = round == 0 ? seconds : std::min(least[k], seconds);
    }
  }
  return least;
}

double millions(std::uint64_t count) { return static_cast<double>(count) / 1e6; }

Result<Plot> make_plot(Study& study, const Field& field) {
  Plot plot{fmt::format("Samples scanned by Algorithms I, II and III, {}", field.key),
            "vertices m",
            "samples scanned",
            true,
            true,
            "top left",
            {}};
  for (std::size_t k = 0; k < kNames.size(); ++k)
    plot.curves.push_back({kNames[k], Curve::Style::kLineAndPoints, {}, static_cast<int>(k) + 1});
  plot.curves[1].style = Curve::Style::kPoints;
  plot.curves[2].style = Curve::Style::kLine;
  for (std::uint64_t m = 8; m <= std::min<std::uint64_t>(512, field.samples() / 4); m *= 2) {
    study.note(fmt::format("algorithms: {}, {} vertices", field.key, m));
    SCARP_TRY(const Runs& runs, run(study, field, m));
    for (std::size_t k = 0; k < kNames.size(); ++k)
      plot.curves[k].points.push_back({static_cast<double>(m), static_cast<double>(runs.works[k].samples_scanned)});
  }
  return plot;
}

}  // namespace

Result<void> add_algorithms(Study& study) {
  const std::vector<const Field*> fields = study.choose(kSmallFields);
  if (fields.empty()) return {};
  std::vector<std::vector<std::string>> rows;
  bool all_same = true;
  for (const Field* field : fields) {
    const std::uint64_t vertices = std::max<std::uint64_t>(field->share(0.1), 8);
    study.note(fmt::format("algorithms: {}, {} vertices", field->key, vertices));
    SCARP_TRY(const Runs& runs, run(study, *field, vertices));
    all_same = all_same && runs.same;
    const auto& [one, two, three] = runs.works;
    std::vector<std::string> row{field->key,
                                 fmt::format("{}", vertices),
                                 number(millions(one.samples_scanned)),
                                 number(millions(two.samples_scanned)),
                                 number(millions(three.samples_scanned)),
                                 number(static_cast<double>(one.samples_scanned) /
                                        static_cast<double>(std::max<std::uint64_t>(three.samples_scanned, 1))),
                                 fmt::format("{}", two.queue_moves),
                                 fmt::format("{}", three.queue_moves),
                                 runs.same ? "yes" : "no"};
    if (study.timing) {
      SCARP_TRY(const auto& seconds, time_all(study, *field, vertices));
      row.push_back(number(seconds[0] / seconds[2]));
      row.push_back(number(seconds[1] / seconds[2]));
    }
    rows.push_back(std::move(row));
  }
  study.page.heading(2, "Algorithms I, II and III (section 4, pages 8, 11 and 13)");
  std::vector<std::string> header{"field",    "m",       "million samples scanned, I",   "II",
                                  "III",      "I / III", "triangles looked through, II", "entries moved, III",
                                  "same mesh"};
  if (study.timing) {
    header.push_back("CPU time I / III (measured once)");
    header.push_back("CPU time II / III (measured once)");
  }
  study.page.table(header, rows);
  SCARP_TRY(const Plot& plot, make_plot(study, *fields.front()));
  SCARP_RETURN_IF_ERROR(study.add_plot("algorithms", plot));
  study.page.list({all_same
                       ? "All three insert the same samples in the same order: the meshes are equal to the last bit."
                       : "The meshes are not all equal, which they should be.",
                   "I scans every sample before each insertion, n·m of them. II and III scan only the triangles around "
                   "the new vertex; II then searches all triangles for the worst, III has them in a heap."});
  return {};
}

}  // namespace scarp::paper
