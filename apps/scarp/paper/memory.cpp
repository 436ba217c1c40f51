// Memory for each vertex, as the system counts it.
#include <fmt/format.h>
#include <malloc.h>

#include <array>
#include <cstdio>
#include <memory>
#include <vector>

#include "paper/study.h"

namespace scarp::paper {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

/// A line of /proc/self/status, in bytes.
std::optional<double> read_status(const std::string& name) {
  const File status(std::fopen("/proc/self/status", "r"));
  std::array<char, 256> line{};
  while (status && std::fgets(line.data(), static_cast<int>(line.size()), status.get()) != nullptr) {
    unsigned long long kilobytes = 0;
    if (std::sscanf(line.data(), (name + ": %llu kB").c_str(), &kilobytes) == 1)
      return 1024 * static_cast<double>(kilobytes);
  }
  return std::nullopt;
}

/// Gives free memory back and restarts the peak.
bool restart_peak() {
  malloc_trim(0);
  const File file(std::fopen("/proc/self/clear_refs", "w"));
  return file && std::fputs("5", file.get()) >= 0 && std::fflush(file.get()) == 0;
}

/// With fewer the fixed cost of a run would seem to be the vertices'.
constexpr std::uint64_t kLeastVertices = 50'000;

}  // namespace

Result<void> add_memory(Study& study) {
  if (!study.timing) return {};
  const Field* field = nullptr;
  for (const Field& candidate : study.fields.all) {
    if (field == nullptr || candidate.samples() > field->samples()) field = &candidate;
  }
  if (field->share(10) < kLeastVertices) return {};
  std::vector<std::vector<std::string>> rows;
  for (const double share : {10.0, 50.0}) {
    study.note(fmt::format("memory: {}, {} vertices", field->key, field->share(share)));
    if (!restart_peak()) return {};
    const auto before = read_status("VmRSS");
    SCARP_TRY(const Trial& trial, study.refine(*field, field->share(share)));
    const auto peak = read_status("VmHWM");
    if (!before || !peak) return {};
    const double bytes = *peak - *before;
    rows.push_back({field->key, fmt::format("{}", trial.vertices), fmt::format("{:.1f}", bytes / 1e6),
                    fmt::format("{:.0f}", bytes / static_cast<double>(trial.vertices))});
  }
  study.page.heading(2, "Memory");
  study.page.paragraph(
      "*Measured once, on the machine that wrote this page:* the peak of resident memory during `simplify()`, judging "
      "included, without the samples (4 bytes each).");
  study.page.table({"field", "m", "MB", "bytes a vertex"}, rows);
  if (!study.fields.are_of_paper) return {};
  study.page.paragraph(fmt::format(
      "Scape in a 64-bit build: about {:g} bytes a vertex, samples included; counted from its structures with 4-byte "
      "pointers: {:g}; named for the paper: about {:g}.",
      kScapeBytesMeasured, kScapeBytesCounted, kReportBytes));
  return {};
}

}  // namespace scarp::paper
