// Section 4: how much work Algorithm III does: samples scanned and entries moved in the queue, against n log m.
#include <fmt/format.h>

#include <cmath>

#include "paper/study.h"

namespace scarp::paper {
namespace {

constexpr std::array kLargeFields{"ntc", "westUS"};
constexpr double kShares[] = {0.1, 1, 10, 50};  ///< percent of the samples

/// y = slope · x + offset through points, least squares.
struct Line {
  double slope = 0, offset = 0;
};
Line fit(const std::vector<std::array<double, 2>>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [px, py] : points) {
    n += 1;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
  }
  Line line;
  line.slope = (n * xy - x * y) / (n * xx - x * x);
  line.offset = (y - line.slope * x) / n;
  return line;
}

struct Series {
  const Field* field;
  std::vector<std::uint64_t> vertices;
  std::vector<Trial> trials;
  Line line;  ///< scans() / n against ln m
};

/// Samples scanned but for the three corners of each triangle: Scape passes over samples that are vertices.
double scans(const Trial& trial) {
  return static_cast<double>(trial.work.samples_scanned) - 3 * static_cast<double>(trial.work.triangles_scanned);
}

Result<Series> run(Study& study, const Field& field) {
  Series series{&field, {}, {}, {}};
  std::vector<std::array<double, 2>> points;
  for (const double share : kShares) {
    const std::uint64_t vertices = field.share(share);
    if (vertices < 5) continue;
    study.note(fmt::format("effort: {}, {} vertices", field.key, vertices));
    SCARP_TRY(const Trial& trial, study.delaunay(field, vertices));
    series.vertices.push_back(vertices);
    series.trials.push_back(trial);
    points.push_back({std::log(static_cast<double>(vertices)), scans(trial) / static_cast<double>(field.samples())});
  }
  if (points.size() > 1) series.line = fit(points);
  return series;
}

std::string describe(const Line& line) {
  return fmt::format("{:.2f} ln m {} {:.1f}", line.slope, line.offset < 0 ? "−" : "+", std::abs(line.offset));
}

Plot make_plot(const Study& study, const std::vector<Series>& all) {
  Plot plot{"Samples scanned by Algorithm III", "vertices m", "samples scanned / n", true, false, "top left", {}};
  int color = 0;
  for (const Series& series : all) {
    ++color;
    const auto n = static_cast<double>(series.field->samples());
    Curve measured{series.field->key, Curve::Style::kPoints, {}, color};
    Curve fitted{describe(series.line), Curve::Style::kLine, {}, color};
    for (std::size_t k = 0; k < series.vertices.size(); ++k) {
      const auto m = static_cast<double>(series.vertices[k]);
      measured.points.push_back({m, scans(series.trials[k]) / n});
      fitted.points.push_back({m, series.line.slope * std::log(m) + series.line.offset});
    }
    plot.curves.push_back(std::move(measured));
    plot.curves.push_back(std::move(fitted));
  }
  if (study.fields.are_of_paper) {
    Curve scape{"Scape", Curve::Style::kLineAndPoints, {}, 6};
    for (const ScanFigure& figure : kScans)
      scape.points.push_back({static_cast<double>(figure.vertices), figure.millions * 1e6 / (1024 * 1024)});
    plot.curves.push_back(std::move(scape));
  }
  return plot;
}

std::optional<double> scape_scans(const Study& study, const Field& field, std::uint64_t vertices) {
  for (const ScanFigure& figure : kScans) {
    if (study.fields.are_of_paper && field.key == kScanField && figure.vertices == vertices) return figure.millions;
  }
  return std::nullopt;
}

}  // namespace

Result<void> add_effort(Study& study) {
  const std::vector<const Field*> fields = study.choose(kLargeFields);
  if (fields.empty()) return {};
  std::vector<Series> all;
  std::vector<std::vector<std::string>> rows;
  Differences counts;
  double least = 1e300, most = 0;
  for (const Field* field : fields) {
    SCARP_TRY(Series series, run(study, *field));
    for (std::size_t k = 0; k < series.trials.size(); ++k) {
      const Trial& trial = series.trials[k];
      const double millions = scans(trial) / 1e6;
      const double moves = static_cast<double>(trial.work.queue_moves) / static_cast<double>(trial.vertices);
      const auto scape = scape_scans(study, *field, series.vertices[k]);
      counts.add(fmt::format("{} at {} vertices", field->key, series.vertices[k]), millions, scape);
      least = std::min(least, moves);
      most = std::max(most, moves);
      rows.push_back({field->key, fmt::format("{}", trial.vertices),
                      number(static_cast<double>(trial.work.samples_scanned) / 1e6), beside(millions, scape),
                      number(static_cast<double>(trial.work.triangles_scanned) / static_cast<double>(trial.vertices)),
                      number(moves)});
    }
    all.push_back(std::move(series));
  }
  study.page.heading(2, "The cost of Algorithm III (section 4, page 13)");
  study.page.paragraph("Expected: O((n + m) log m) for n samples and m vertices.");
  study.page.table(
      {"field", "m", "million samples scanned", "without corners", "triangles scanned / m", "queue entries moved / m"},
      rows);
  SCARP_RETURN_IF_ERROR(study.add_plot("effort", make_plot(study, all)));
  std::vector<std::string> remarks;
  for (const Series& series : all) {
    const bool compares = study.fields.are_of_paper && series.field->key == kScanField;
    remarks.push_back(fmt::format("Fitted on {}: samples scanned, without corners, = n ({}){}.", series.field->key,
                                  describe(series.line),
                                  compares ? "; Scape: n (" + describe({kScanSlope, kScanOffset}) + ")" : ""));
  }
  remarks.push_back(fmt::format(
      "The queue moves {} to {} entries a vertex{}: log m, as a heap should.", number(least), number(most),
      study.fields.are_of_paper ? fmt::format(" (Scape: {:g} to {:g} swaps)", kSwapsLeast, kSwapsMost) : ""));
  if (!counts.empty()) {
    remarks.push_back(counts.sentence("counts of samples") +
                      " Scape skips samples that are vertices, Scarp scans the corners of each triangle: hence the "
                      "column without them.");
  }
  study.page.list(remarks);
  return {};
}

}  // namespace scarp::paper
