// The reference runs that the engine must match: Scape 1.2 (Garland & Heckbert's program, Delaunay) on its own five
// fields, measured with the original program. Vertices include the four corners; RMSE is over all samples.
#pragma once

#include <cstdint>

namespace bench {

struct ReferenceRow {
  const char* field;  ///< scape_FIELD.stm
  std::uint64_t vertices;
  std::uint64_t triangles;
  double max_error, rmse;
  double seconds;  ///< seconds of the scan and the insertions on one core of a cloud Xeon
};

inline constexpr ReferenceRow kReferenceRows[] = {
    {"crater", 154, 288, 117.40, 33.565, 0.007},     {"crater", 1542, 3008, 24.263, 7.0780, 0.016},
    {"crater", 7711, 15229, 6.447, 2.0055, 0.04},    {"crater", 15422, 30567, 4.000, 1.0995, 0.08},
    {"ashby", 156, 295, 78.00, 18.578, 0.006},       {"ashby", 1564, 3076, 20.460, 5.7737, 0.018},
    {"ashby", 7820, 15481, 7.500, 2.0119, 0.05},     {"ozark", 170, 329, 29.73, 9.3614, 0.007},
    {"ozark", 1705, 3340, 10.833, 3.2737, 0.02},     {"ozark", 8524, 16848, 3.681, 1.1966, 0.05},
    {"ntc", 1049, 2048, 68.16, 16.445, 0.06},        {"ntc", 10486, 20768, 13.958, 4.0127, 0.15},
    {"ntc", 52429, 104396, 5.150, 1.4495, 0.39},     {"ntc", 104858, 209021, 2.556, 0.8979, 0.9},
    {"ntc", 524288, 1046491, 0.500, 0.2039, 2.9},    {"westUS", 1049, 2058, 227.2, 64.770, 0.06},
    {"westUS", 10486, 20820, 57.828, 16.858, 0.13},  {"westUS", 52429, 104488, 17.75, 5.8399, 0.37},
    {"westUS", 104858, 209144, 11.00, 3.5810, 0.75}, {"westUS", 524288, 1046717, 1.50, 0.5278, 3.4},
};

/// Tolerances of every row. The max error is omitted, since it depends on ties and the first diagonal.
inline constexpr double kRmseTolerance = 0.01, kTriangleTolerance = 0.005;

}  // namespace bench
