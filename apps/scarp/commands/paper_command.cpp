#include "commands/paper_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <utility>

#include "paper/study.h"
#include "scarp/version.h"
#include "session/plan/outputs.h"
#include "session/table/option_table.h"
#include "session/text/text.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {

namespace fs = std::filesystem;

constexpr Result<void> (*kExperiments[])(paper::Study&) = {
    paper::add_illustration,   paper::add_memory,           paper::add_selectors,    paper::add_algorithms,
    paper::add_effort,         paper::add_batches,          paper::add_edge_rules,   paper::add_edge_sweep,
    paper::add_supersampling,  paper::add_settling,         paper::add_surfaces,     paper::add_synthetic,
    paper::add_reference_rows, paper::add_cross_checks,     paper::add_error_curves, paper::add_edge_curves,
    paper::add_seconds,        paper::add_textured_terrain, paper::add_images};

void add_header(paper::Study& study) {
  study.page.heading(1, "The experiments of the 1995 paper");
  study.page.paragraph(fmt::format(
      "Written by `scarp paper --data DIR{}` (Scarp {}; `make paper` runs it), not edited by hand. It repeats the "
      "known experiments of M. Garland and P. S. Heckbert, *Fast Polygonal Approximation of Terrains and Height "
      "Fields* (CMU-CS-95-181, 1995): the paper.",
      study.timing ? "" : " --no-timing", version()));
  if (study.fields.are_of_paper) {
    study.page.paragraph(
        "In brackets: the figure of Scape 1.2, the paper's own program, on the same fields "
        "(`apps/scarp/paper/figures.h`), and Scarp's difference from it. The fields are the paper's five: Crater Lake, "
        "Ashby Gap, Ozark, the National Training Center (ntc) and the western US. Errors are vertical, in metres, over "
        "all samples.");
    study.page.paragraph(
        "Sections, pages and figures in brackets are the paper's. Only its first pages, with its contents, and the "
        "sources of its programs were at hand; claims beyond these are marked as not verified.");
  } else {
    study.page.paragraph(
        "The folder holds none of the paper's fields, so there are no figures to compare with but for the synthetic "
        "fields. Sections, pages and figures in brackets are the paper's.");
  }
  study.page.paragraph(
      study.timing
          ? "Times and memory are marked as measured once; all other numbers are the same on every run and machine."
          : "All numbers are the same on every run and machine.");
  std::vector<std::vector<std::string>> rows;
  for (const paper::Field& field : study.fields.all) {
    rows.push_back(
        {field.key, fmt::format("{} × {}", field.heights.cols, field.heights.rows), fmt::format("{}", field.samples()),
         fmt::format("{} to {}", format_number(field.heights.info.min), format_number(field.heights.info.max))});
  }
  study.page.table({"field", "size", "samples n", "heights"}, rows);
  if (!study.fields.left_out.empty()) {
    study.page.paragraph("Left out:");
    study.page.list(study.fields.left_out);
  }
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return fail(ErrorKind::kOutput, fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
}

/// The pictures, then the page that shows them.
Result<void> write_all(const paper::Study& study, const fs::path& page, bool overwrite) {
  Result<void> done;
  for (const auto& picture : study.pictures()) {
    if (done) done = write_file((page.parent_path() / picture.path).string(), picture.bytes, overwrite);
  }
  SCARP_RETURN_IF_ERROR(done);
  const std::string& text = study.page.text();
  return write_file(page.string(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, overwrite);
}

}  // namespace

PaperCommand::PaperCommand(CLI::App& program) : command_(add_command(program, kPaper)) {
  add_option(*command_, OptionId::kData, data_);
  add_option(*command_, OptionId::kOut, out_);
  add_flag(*command_, OptionId::kNoTiming, no_timing_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
}

Result<void> PaperCommand::run() const {
  const fs::path page = fs::path(out_) / "paper.md";
  std::error_code error;
  if (out_.empty()) return fail(ErrorKind::kUsage, "--out is empty: name a folder");
  if (fs::exists(page, error) && !overwrite_) {
    return fail(ErrorKind::kOutput, fmt::format("{} exists already: --overwrite replaces it", page.string()));
  }
  SCARP_RETURN_IF_ERROR(paper::find_gnuplot());
  SCARP_TRY(paper::Fields fields, paper::read_fields(data_));
  Result<void> has_place = make_folder(page.parent_path() / "images" / "paper");
  if (has_place) has_place = check_outputs({{"--out", page.string()}}, {}, overwrite_);
  SCARP_RETURN_IF_ERROR(has_place);
  paper::Study study(std::move(fields), data_, !no_timing_, quiet_);
  add_header(study);
  for (const auto& add_experiment : kExperiments) {
    SCARP_RETURN_IF_ERROR(add_experiment(study));
    if (interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
  }
  const Result<void> written = write_all(study, page, overwrite_);
  if (!written || quiet_) return written;
  return print_to_stdout(fmt::format("{}, {} pictures\n", page.string(), study.pictures().size()));
}

}  // namespace scarp::cli
