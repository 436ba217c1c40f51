// Section 5: seconds, on the machine that writes the page.
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <utility>

#include "paper/reference_rows.h"
#include "paper/study.h"

namespace scarp::paper {
namespace {

/// Short runs are repeated more often: what else the machine does then disturbs less.
constexpr int kLeastRounds = 3, kMostRounds = 25;
constexpr double kSecondsOfRounds = 0.5;

/// "2026-11-23, AMD EPYC, 2 logical processors, load 0.8"
std::string describe_machine() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm day{};
  gmtime_r(&now, &day);
  std::string text = fmt::format("{:04}-{:02}-{:02}, ", day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);) {
    if (line.rfind("model name", 0) != 0 || line.find(": ") == std::string::npos) continue;
    text += line.substr(line.find(": ") + 2) + ", ";
    break;
  }
  text += fmt::format("{} logical processors", sysconf(_SC_NPROCESSORS_ONLN));
  double load = 0;
  return getloadavg(&load, 1) == 1 ? text + fmt::format(", load {:.1f}", load) : text;
}

/// The least of some rounds. `run` gives seconds.
template <class Run>
Result<double> least(Run run) {
  double best = 0, sum = 0;
  for (int round = 0; round < kLeastRounds || (round < kMostRounds && sum < kSecondsOfRounds); ++round) {
    SCARP_TRY(const double seconds, run());
    sum += seconds;
    best = round == 0 ? seconds : std::min(best, seconds);
  }
  return best;
}

struct TimeRow {
  const Field* field;
  std::uint64_t vertices;
  const ReferenceRow* scape;  ///< null: not the paper's
};

std::vector<TimeRow> list_rows(const Study& study) {
  std::vector<TimeRow> rows;
  if (study.fields.are_of_paper) {
    for (const ReferenceRow& row : kReferenceRows) {
      if (const Field* field = study.find(row.field)) rows.push_back({field, row.vertices, &row});
    }
  } else {
    for (const Field& field : study.fields.all)
      rows.push_back({&field, std::max<std::uint64_t>(field.share(1), 5), nullptr});
  }
  return rows;
}

}  // namespace

Result<void> add_seconds(Study& study) {
  if (!study.timing) return {};
  const std::string machine = describe_machine();
  std::vector<std::vector<std::string>> cells;
  double million = 0;  // seconds for 1 % of a million samples, the worst of those there are
  for (const TimeRow& row : list_rows(study)) {
    study.note(fmt::format("seconds: {}, {} vertices", row.field->key, row.vertices));
    const auto refine = [&](const EdgeRule& edges) {
      return least([&]() -> Result<double> { return study.time(*row.field, row.vertices, with_edges(edges)); });
    };
    SCARP_TRY(const double delaunay, refine({}));
    SCARP_TRY(const double data_dependent, refine(scape_edges(EdgeScore::kSum, 0.5)));
    if (row.field->samples() >= 1'000'000 && row.vertices == row.field->share(1)) million = std::max(million, delaunay);
    std::vector<std::string> line{row.field->key,
                                  fmt::format("{}", row.vertices),
                                  fmt::format("{:.3f}", delaunay),
                                  fmt::format("{:.2f}", static_cast<double>(row.field->samples()) / 1e6 / delaunay),
                                  fmt::format("{:.3f}", data_dependent),
                                  fmt::format("{:.2f}", data_dependent / delaunay)};
    if (row.scape != nullptr) line.insert(line.begin() + 2, fmt::format("{:g}", row.scape->seconds));
    cells.push_back(std::move(line));
  }
  std::vector<std::string> header{"field", "m", "Delaunay, s", "million samples a second", "sum, q 0.5, s", "ratio"};
  if (study.fields.are_of_paper) header.insert(header.begin() + 2, "Scape, Delaunay, s");
  study.page.heading(3, "Seconds");
  study.page.paragraph(fmt::format(
      "*Measured once, on the machine that wrote this page ({}):* CPU time of triangulation without reading and "
      "judging, on one thread, in the greedy order; the least of {} to {} runs.{}",
      machine, kLeastRounds, kMostRounds,
      study.fields.are_of_paper
          ? " Scape's seconds are another machine's: one core of a cloud Xeon, g++ 12 -O2, the same part of the work."
          : ""));
  study.page.table(header, cells);
  if (study.fields.are_of_paper && million > 0) {
    study.page.list({
        fmt::format("The paper's abstract: a field of a million samples \"quite accurately\" in under a minute, on a "
                    "workstation of 1995. Here 1 % of such a field takes {:.2f} s.",
                    million),
        fmt::format("Not verified, for the text is not at hand: 21 s for a field of 1024 × 1024 and 1 % of its "
                    "samples, on an SGI Indigo2 (R4400, 150 MHz), that is {:.0f} times as long; data-dependent edges "
                    "three to four times as long as Delaunay's (Scape, measured: {:g} to {:g}).",
                    kReportSeconds / million, kDataDependentTimeLeast, kDataDependentTimeMost),
        "The default, the dominant order, is faster ([performance](performance.md)).",
    });
  }
  return {};
}

}  // namespace scarp::paper
