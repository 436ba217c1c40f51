// The engine against the paper's program: 20 runs of Scape 1.2 on its five fields.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "../../bench/harness.h"
#include "../../bench/quality/reference_rows.h"
#include "laws/sanitized.h"
#include "scarp/scarp.h"
#include "source_dir.h"

namespace {

class ReferenceRows : public testing::TestWithParam<const char*> {};

/// Like this test, Scape inserts the worst sample up to a number of vertices. Ties and float arithmetic differ, so
/// meshes are similar, not equal.
TEST_P(ReferenceRows, HaveScapesErrorAndTriangles) {
  const std::string file = std::string("scape_") + GetParam() + ".stm";
  const auto path = bench::find_raster(scarp::source_dir(), file);
  if (!path) GTEST_SKIP() << file << " is not in ../shared/data";
  auto field = scarp::read_height_field(*path);
  ASSERT_TRUE(field) << field.error().message;
  auto refiner = scarp::Refiner::create(*field);
  ASSERT_TRUE(refiner) << refiner.error().message;
  int rows = 0;
  for (const auto& row : bench::kReferenceRows) {
    if (std::string(row.field) != GetParam()) continue;
    SCOPED_TRACE(row.vertices);
    while (refiner->vertex_count() < row.vertices) ASSERT_TRUE(refiner->insert_worst());
    scarp::MeasureOptions heights_only;
    heights_only.topology = false;
    const auto judged = scarp::measure(*field, refiner->mesh(), heights_only);
    ASSERT_TRUE(judged) << judged.error().message;
    EXPECT_EQ(judged->vertices, row.vertices);
    EXPECT_EQ(judged->uncovered, 0u);
    EXPECT_NEAR(judged->rmse, row.rmse, bench::kRmseTolerance * row.rmse);
    EXPECT_NEAR(static_cast<double>(judged->triangles), static_cast<double>(row.triangles),
                bench::kTriangleTolerance * static_cast<double>(row.triangles));
    EXPECT_NEAR(judged->max_error, refiner->max_error(), 1e-6 * row.max_error);
    ++rows;
  }
  EXPECT_GT(rows, 0);
}

std::vector<const char*> fields() {
  std::vector<const char*> all = {"crater", "ashby", "ozark", "ntc", "westUS"};
  if (scarp::testing::kIsSanitized) all.resize(3);  // the others are five times as large
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scape, ReferenceRows, testing::ValuesIn(fields()),
                         [](const auto& field) { return std::string(field.param); });

}  // namespace
