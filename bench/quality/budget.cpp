// The results of effort and objective for a budget: as many triangles as greedy insertion needs at 1 % of the relief,
// and at 0.3 % where these are fewer than 100,000 → max error and RMSE, as measure() judges them. Times go to a table
// of their own: this one is the same on every machine.
//
//   scarp_budget PROJECT BUDGETS.csv SECONDS.csv [NAME...]
//
// All of PROJECT/bench/quality/budgets.txt, or the named ones, whose rows then are put in place of the old ones. Ends
// with 3 as soon as a mesh has more triangles than the budget, does not cover a sample or is not sound; and, when all
// is done, if `high` had a larger max error than `normal` anywhere.

#include <fmt/format.h>

#include <cstdio>
#include <limits>

#include "files.h"
#include "judge.h"
#include "scarp/scarp.h"
#include "variants.h"

namespace {

constexpr double kPercentsOfRelief[] = {1, 0.3};
constexpr std::uint64_t kMostOfMore = 100'000;  ///< a second budget that is larger is omitted

constexpr const char* kHeader =
    "raster,cols,rows,valid,percent_of_relief,budget,variant,triangles,max_error,rmse,angle_p1,thin_percent\n";
constexpr const char* kSecondsHeader = "raster,percent_of_relief,variant,cpu_seconds\n";

struct Tables {
  std::string budgets = kHeader, seconds = kSecondsHeader;
};

void add_rows(const std::string& name, const scarp::OwnedHeightField& field, double percent, std::uint64_t budget,
              std::string_view variant, const bench::Made& made, Tables& tables) {
  const scarp::Measurement& judged = made.judged;
  tables.budgets += fmt::format("{},{},{},{},{:g},{},{},{},{:.7g},{:.7g},{:.3f},{:.2f}\n", name, field.cols, field.rows,
                                field.info.valid, percent, budget, variant, judged.triangles, judged.max_error,
                                judged.rmse, judged.angle_percentiles[0], made.thin_percent);
  tables.seconds += fmt::format("{},{:g},{},{:.3f}\n", name, percent, variant, made.seconds);
  fmt::print("{:28}{:4g} %{:9}  {:11}{:9}{:11.5g}{:11.5g}{:9.3f} s\n", name, percent, budget, variant, judged.triangles,
             judged.max_error, judged.rmse, made.seconds);
  std::fflush(stdout);
}

int complain(const std::string& name, double percent, std::string_view variant, const std::string& fault) {
  fmt::print(stderr, "{}, {:g} % of the relief, {}: {}\n", name, percent, variant, fault);
  return 3;
}

/// Both budgets of one raster; the program's exit code. `worse` counts where high had a larger max error than normal.
int run(const std::string& name, const scarp::OwnedHeightField& field, Tables& tables, int& worse) {
  const double relief = field.info.max - field.info.min;
  for (const double percent : kPercentsOfRelief) {
    const double error = percent / 100 * relief;
    const auto greedy = bench::make(field, bench::options_of(bench::kVariants[0], error));
    if (!greedy) return complain(name, percent, "greedy", greedy.error().message);
    const std::uint64_t budget = greedy->judged.triangles;
    if (percent < kPercentsOfRelief[0] && budget >= kMostOfMore) continue;
    add_rows(name, field, percent, budget, "greedy", *greedy, tables);
    double normal_error = 0;
    for (const bench::BudgetVariant& variant : bench::kBudgetVariants) {
      if (static_cast<double>(budget) > variant.most_budget) continue;
      const auto made = bench::make(field, bench::options_of(variant, budget));
      if (!made) return complain(name, percent, variant.name, made.error().message);
      std::string fault = bench::find_fault(made->judged, std::numeric_limits<double>::infinity());
      if (made->judged.triangles > budget) fault = fmt::format("it has {} triangles", made->judged.triangles);
      if (!fault.empty()) return complain(name, percent, variant.name, fault);
      add_rows(name, field, percent, budget, variant.name, *made, tables);
      if (variant.name == "normal") normal_error = made->judged.max_error;
      if (variant.name == "high" && made->judged.max_error > normal_error) {
        complain(name, percent, variant.name,
                 fmt::format("its max error is {:.7g}, that of normal {:.7g}", made->judged.max_error, normal_error));
        ++worse;
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: scarp_budget PROJECT BUDGETS.csv SECONDS.csv [NAME...]\n");
    return 1;
  }
  const std::filesystem::path project = argv[1];
  const std::vector<std::string> all = bench::read_names(project / "bench/quality/budgets.txt");
  std::vector<std::string> names(argv + 4, argv + argc);
  if (names.empty()) names = all;
  int worse = 0;
  for (const std::string& name : names) {
    const auto field = bench::read_field(project, name);
    if (!field) return bench::fail_with(field.error().message);
    Tables tables;
    if (const int code = run(name, *field, tables, worse)) return code;
    for (const auto& [path, table] : {std::pair{argv[2], &tables.budgets}, {argv[3], &tables.seconds}}) {
      if (const int code = bench::write_table(path, bench::replace_rows(path, *table, name, all))) return code;
    }
  }
  return worse == 0 ? 0 : 3;
}
