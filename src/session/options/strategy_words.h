// Words for the library's strategies, for parsing and reports.
#pragma once

#include "scarp/paper.h"
#include "scarp/simplify.h"
#include "session/options/values.h"

namespace scarp::cli {

inline constexpr Choice<Vertices> kVertexWords[] = {{"samples", Vertices::kSamples}, {"free", Vertices::kFree}};
inline constexpr Choice<Objective> kObjectives[] = {{"max", Objective::kMax}, {"rms", Objective::kRms}};
inline constexpr Choice<Algorithm> kAlgorithms[] = {
    {"brute", Algorithm::kBruteForce}, {"local", Algorithm::kLocal}, {"heap", Algorithm::kHeap}};
inline constexpr Choice<bool> kEdgeWords[] = {{"delaunay", false}, {"data", true}};
inline constexpr Choice<EdgeScore> kScores[] = {{"sum", EdgeScore::kSum},
                                                {"max", EdgeScore::kMax},
                                                {"sqerr", EdgeScore::kSquares},
                                                {"abn", EdgeScore::kNormals},
                                                {"tight", EdgeScore::kTight}};

}  // namespace scarp::cli
