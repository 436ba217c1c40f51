// Max error and RMSE by effort and objective for a budget: the triangles that greedy insertion needs at 1 % of the
// relief, and at 0.3 % if fewer than 100,000. Fails if `high` has a larger max error than `normal`.

#include "suite.h"
#include "variants.h"

namespace bench {
namespace {

constexpr char kList[] = "budgets";
constexpr double kPercentsOfRelief[] = {1, 0.3};
constexpr std::uint64_t kMostOfMore = 100'000;       ///< a larger second budget is omitted
constexpr const char* kWalls = "athens_dsm_1m.tif";  ///< reported separately: its times are not in the mean

void add_row(const std::string& name, const scarp::OwnedHeightField& field, double percent, std::uint64_t budget,
             std::string_view variant, const Made& made, Rows& rows) {
  const scarp::Measurement& judged = made.judged;
  rows.add(fmt::format("{},{},{},{},{:g},{},{},{},{:.7g},{:.7g},{:.3f},{:.2f}", name, field.cols, field.rows,
                       field.info.valid, percent, budget, variant, judged.triangles, judged.max_error, judged.rmse,
                       judged.angle_percentiles[0], made.thin_percent));
}

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  for (const double percent : kPercentsOfRelief) {
    const std::string what = fmt::format("{}, {:g} % of the relief, ", name, percent);
    const Made greedy = make(what + "greedy", field, options_of(kVariants[0], percent / 100 * relief_of(field)));
    const std::uint64_t budget = greedy.judged.triangles;
    if (percent < kPercentsOfRelief[0] && budget >= kMostOfMore) continue;
    add_row(name, field, percent, budget, "greedy", greedy, rows);
    double normal_error = 0;
    for (const BudgetVariant& variant : kBudgetVariants) {
      if (static_cast<double>(budget) > variant.most_budget) continue;
      const Made made = make(what + std::string(variant.name), field, options_of(variant, budget));
      add_row(name, field, percent, budget, variant.name, made, rows);
      if (name != kWalls) rows.add_time(variant.name, made.seconds / greedy.seconds);
      if (variant.name == "normal") normal_error = made.judged.max_error;
      if (variant.name == "high" && made.judged.max_error > normal_error) die(what + "high: a larger error than normal", 3);
    }
  }
}

}  // namespace

const Suite kBudgets{"budgets",
                     "raster,cols,rows,valid,percent_of_relief,budget,variant,triangles,max_error,rmse,angle_p1,"
                     "thin_percent",
                     names_in<kList>, measure};

}  // namespace bench
