// The mesh as lines on paper: SVG and EPS.
//
// Edges are collected from the triangles that face up, then sorted and deduplicated, so a shared side is one line.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "scarp/picture.h"

namespace scarp {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

double area_of(const Mesh& mesh, const std::uint32_t* v) {
  std::array<double, 3> x{}, y{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (v[k] >= mesh.vertex_count()) return 0;
    x[k] = mesh.positions[3 * std::size_t{v[k]}];
    y[k] = mesh.positions[3 * std::size_t{v[k]} + 1];
  }
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  return std::isfinite(area) ? area : 0;
}

/// Edges of the triangles that face up or, if there are none, of those that face down.
std::vector<Edge> list_edges(const Mesh& mesh) {
  std::vector<Edge> up, down;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* v = &mesh.triangles[3 * t];
    const double area = area_of(mesh, v);
    if (area == 0 || (area < 0 && !up.empty())) continue;
    for (std::size_t k = 0; k < 3; ++k) (area > 0 ? up : down).push_back(std::minmax(v[k], v[(k + 1) % 3]));
  }
  std::vector<Edge>& edges = up.empty() ? down : up;
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return std::move(edges);
}

/// The mesh on a page: its longer side is `side` long, plus a margin.
class Page {
 public:
  Page(const Mesh& mesh, double side) : mesh_(mesh), edges_(list_edges(mesh)) {
    std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (const auto& [a, b] : edges_) {
      for (const std::uint32_t v : {a, b}) {
        for (std::size_t k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], mesh.positions[3 * std::size_t{v} + k]);
          high[k] = std::max(high[k], mesh.positions[3 * std::size_t{v} + k]);
        }
      }
    }
    if (edges_.empty()) low = high = {0, 0};
    const double extent = std::max(high[0] - low[0], high[1] - low[1]);
    scale_ = extent > 0 ? side / extent : 1;
    low_ = low;
    width_ = (high[0] - low[0]) * scale_ + 2 * kMargin;
    height_ = (high[1] - low[1]) * scale_ + 2 * kMargin;
    double length = 0;
    for (const Edge& edge : edges_) {
      const auto [a, b] = ends(edge);
      length += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    // Thin enough to leave white between the lines of a dense mesh.
    if (!edges_.empty()) line_width_ = std::clamp(length / static_cast<double>(edges_.size()) / 12, 0.02, 0.6);
  }

  const std::vector<Edge>& edges() const { return edges_; }
  double width() const { return width_; }
  double height() const { return height_; }
  double line_width() const { return line_width_; }
  /// Coordinates start at the lower left corner of the page.
  std::array<std::array<double, 2>, 2> ends(const Edge& edge) const { return {place(edge.first), place(edge.second)}; }

 private:
  static constexpr double kMargin = 4;
  std::array<double, 2> place(std::size_t v) const {
    return {(mesh_.positions[3 * v] - low_[0]) * scale_ + kMargin,
            (mesh_.positions[3 * v + 1] - low_[1]) * scale_ + kMargin};
  }

  const Mesh& mesh_;
  std::vector<Edge> edges_;
  std::array<double, 2> low_{};
  double scale_ = 1, width_ = 0, height_ = 0, line_width_ = 0.6;
};

}  // namespace

std::vector<std::uint8_t> encode_svg(const Mesh& mesh) {
  const Page page(mesh, 1000);
  std::vector<std::uint8_t> text;
  auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.2f}\" height=\"{1:.2f}\" "
                 "viewBox=\"0 0 {0:.2f} {1:.2f}\">\n<title>Terrain by Scarp</title>\n"
                 "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
                 "<g fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" stroke-width=\"{2:.3f}\">\n",
                 page.width(), page.height(), page.line_width());
  constexpr std::size_t kPathEdges = 500;  // longer paths overload viewers
  for (std::size_t i = 0; i < page.edges().size(); ++i) {
    const auto [a, b] = page.ends(page.edges()[i]);
    const bool begins = i % kPathEdges == 0, ends = i % kPathEdges == kPathEdges - 1 || i + 1 == page.edges().size();
    fmt::format_to(out, "{}M{:.3f} {:.3f}L{:.3f} {:.3f}{}", begins ? "<path d=\"" : "\n", a[0], page.height() - a[1],
                   b[0], page.height() - b[1], ends ? "\"/>\n" : "");
  }
  fmt::format_to(out, "</g>\n</svg>\n");
  return text;
}

std::vector<std::uint8_t> encode_eps(const Mesh& mesh) {
  const Page page(mesh, 540);
  std::vector<std::uint8_t> text;
  auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 {} {}\n%%HiResBoundingBox: 0 0 {:.3f} {:.3f}\n"
                 "%%Creator: Scarp\n%%Title: terrain\n%%LanguageLevel: 1\n%%EndComments\n"
                 "/e {{ moveto lineto stroke }} bind def\n1 setlinecap 0 setgray {:.3f} setlinewidth\n",
                 static_cast<int>(std::ceil(page.width())), static_cast<int>(std::ceil(page.height())), page.width(),
                 page.height(), page.line_width());
  for (const Edge& edge : page.edges()) {
    const auto [a, b] = page.ends(edge);
    fmt::format_to(out, "{:.3f} {:.3f} {:.3f} {:.3f} e\n", a[0], a[1], b[0], b[1]);
  }
  fmt::format_to(out, "showpage\n%%EOF\n");
  return text;
}

}  // namespace scarp
