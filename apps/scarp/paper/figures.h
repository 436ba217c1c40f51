// Reference values of the experiments: figures of Scape 1.2, the paper's own program, measured on its own five fields,
// in the order of the paper's sections. The rows of its results (section 5) are in reference_rows.h.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace scarp::paper {

/// The paper's fields, in its order.
inline constexpr std::array<const char*, 5> kReportFields{"crater", "ashby", "ozark", "ntc", "westUS"};
/// Those that the selectors, the batches and the sweep of thresholds are about.
inline constexpr std::array<const char*, 3> kThreeFields{"crater", "ashby", "westUS"};

/// Position of `key` in one of the lists above; −1 if it is not there.
template <std::size_t N>
constexpr int position_of(const std::array<const char*, N>& keys, std::string_view key) {
  for (std::size_t k = 0; k < N; ++k) {
    if (key == keys[k]) return static_cast<int>(k);
  }
  return -1;
}

/// Section 3: RMS and max error at 1 % of the samples.
struct SelectorFigures {
  std::array<double, 3> rmse, max_error;
};
inline constexpr SelectorFigures kGlobal{{7.08, 5.77, 16.9}, {24.3, 20.5, 57.8}};
inline constexpr SelectorFigures kUniform{{12.9, 9.28, 32.1}, {159, 102, 364}};
inline constexpr SelectorFigures kRandom{{21.5, 15.2, 42.8}, {347, 291, 460}};
inline constexpr SelectorFigures kOnePassLocal4{{66.2, 42.9, 134}, {420, 339, 816}};
inline constexpr SelectorFigures kOnePassLocal8{{75.3, 42.9, 141}, {269, 151, 639}};
inline constexpr SelectorFigures kOnePassCurvature{{72.9, 50.3, 153}, {420, 339, 816}};
inline constexpr SelectorFigures kTimesLocal{{14.8, 9.33, 36.4}, {93, 49, 217}};
inline constexpr SelectorFigures kTimesLocalPlusOne{{12.8, 7.92, 33.4}, {59, 44, 227}};
inline constexpr SelectorFigures kTimesCurvature{{15.6, 9.51, 39.0}, {93, 51, 227}};
inline constexpr SelectorFigures kTimesCurvaturePlusOne{{15.1, 8.89, 37.7}, {70, 47, 227}};
inline constexpr SelectorFigures kTimesRootCurvature{{10.7, 7.28, 24.9}, {47, 32, 123}};

/// Section 4, Algorithm III: samples scanned on a field of 1024 x 1024, in millions. The counts are westUS's.
inline constexpr const char* kScanField = "westUS";
struct ScanFigure {
  std::uint64_t vertices;
  double millions;
};
inline constexpr ScanFigure kScans[] = {{1049, 17.4}, {10486, 25.5}, {104858, 33.2}, {524288, 39.3}};
/// Samples scanned = n (slope · ln m + offset).
inline constexpr double kScanSlope = 3.3, kScanOffset = -6;
inline constexpr double kSwapsLeast = 24, kSwapsMost = 35;  ///< moves in the queue for each vertex

/// Section 4, parallel insertion: vertices and passes that bring the max error below a bound.
struct BatchFigures {
  std::array<double, 3> vertices, passes;
};
inline constexpr std::array<double, 3> kBatchBounds{24.27, 17.0, 57.83};
inline constexpr BatchFigures kSequential{{1542, 1810, 10486}, {1538, 1806, 10482}};
inline constexpr BatchFigures kFraction95{{1841, 2269, 12544}, {350, 429, 1257}};
inline constexpr BatchFigures kFraction90{{2003, 2385, 13376}, {214, 247, 692}};
inline constexpr BatchFigures kFraction70{{2151, 2563, 15300}, {68, 77, 132}};
inline constexpr BatchFigures kFraction50{{2252, 2784, 16035}, {37, 32, 54}};
inline constexpr BatchFigures kConstantBound{{2349, 2928, 16857}, {16, 16, 21}};

/// Memory: bytes for each vertex.
inline constexpr double kScapeBytesMeasured = 600, kScapeBytesCounted = 316, kReportBytes = 192;

/// Section 4.4, data-dependent triangulation: samples scanned against Delaunay, and time.
inline constexpr double kDataDependentScans = 2.1, kDataDependentTimeLeast = 2.6, kDataDependentTimeMost = 3.2;

/// Section 4.4: RMS at 1 % of the samples on the five fields.
using ModeFigures = std::array<double, 5>;
inline constexpr ModeFigures kDelaunayRmse{7.08, 5.77, 3.27, 4.01, 16.86};
inline constexpr ModeFigures kSumRmse{6.22, 5.30, 2.98, 3.61, 15.09};
inline constexpr ModeFigures kSquaresRmse{6.42, 5.30, 3.14, 3.79, 15.49};
inline constexpr ModeFigures kMaxRmse{6.66, 5.47, 3.26, 3.99, 15.96};
inline constexpr ModeFigures kNormalsRmse{7.44, 6.36, 3.62, 4.69, 19.50};
inline constexpr ModeFigures kSumPureRmse{8.32, 7.21, 4.78, 5.64, 22.53};
inline constexpr ModeFigures kSumShapeRmse{7.08, 5.71, 3.26, 4.09, 17.36};
/// Section 4.4: what the sum at threshold 0.5 gains, in percent: RMS at 5 % of the samples, vertices at equal RMS.
inline constexpr double kGainAt5Least = 11, kGainAt5Most = 14, kFewerLeast = 13, kFewerMost = 16;
/// Section 4.4: percent of triangles with an angle below 5 degrees: Delaunay, threshold 0.5, threshold 0.
inline constexpr std::array<double, 3> kThinLeast{0.2, 0.7, 40}, kThinMost{0.9, 4.3, 53};

/// Section 4.4: RMS of the sum at thresholds 0, 0.1, … 1.
inline constexpr std::array<std::array<double, 11>, 3> kSweep{
    {{8.32, 7.04, 6.44, 6.26, 6.16, 6.22, 6.22, 6.42, 6.64, 6.85, 7.08},
     {7.21, 5.80, 5.43, 5.27, 5.13, 5.30, 5.17, 5.20, 5.33, 5.55, 5.71},
     {22.5, 17.9, 16.6, 15.6, 15.1, 15.1, 15.0, 15.0, 15.4, 16.0, 17.4}}};

/// Section 4.4: max errors on synthetic fields of 256 x 256 at 200 vertices: Delaunay, sum at 0.5, sum at 0, normals at
/// 0.
struct SyntheticFigures {
  const char* style;
  std::array<double, 4> max_error;
};
inline constexpr SyntheticFigures kSynthetic[] = {{"parabola", {2.34, 0.91, 1.00, 0.89}},
                                                  {"step", {14.4, 3.35, 2.63, 2.00}},
                                                  {"sharp-step", {81.4, 49.0, 19.5, 3.00}},
                                                  {"diagonal-step", {41.4, 1.20, 0.83, 2.50}},
                                                  {"sharp-diagonal-step", {163, 0.98, 0.92, 2.79}},
                                                  {"cliff", {967, 965, 965, 963}},
                                                  {"paraboloid", {256, 256, 256, 1088}}};
/// Section 4.4: vertices that reproduce the pyramids exactly: Delaunay, sum at 0.5, sum at 0; normals at 0: 11 to 12.
inline constexpr std::array<std::uint64_t, 3> kPyramidVertices{9, 9, 9};

/// Section 5: the max error is not monotone in the vertices: crater.
struct MaxErrorFigure {
  std::uint64_t vertices;
  double max_error;
};
inline constexpr MaxErrorFigure kCraterSpikes[] = {{5000, 9.50}, {7711, 6.45}, {10000, 19.18}, {15422, 4.00}};

/// Section 5: the same greedy insertion by other programs.
struct CrossCheck {
  const char* field;
  std::uint64_t vertices;
  const char* program;
  double max_error, rmse;
};
inline constexpr CrossCheck kCrossChecks[] = {{"crater", 1542, "Scape 1.2", 24.26, 7.078},
                                              {"crater", 1542, "Terra 0.7", 24.25, 7.058},
                                              {"crater", 1542, "delatin", 30.47, 7.067},
                                              {"westUS", 10486, "Scape 1.2", 57.83, 16.858},
                                              {"westUS", 10486, "delatin", 57.79, 16.851}};

/// Section 5, not verified: seconds for 1 % of 1024 x 1024 samples in 1995.
inline constexpr double kReportSeconds = 21;

}  // namespace scarp::paper
