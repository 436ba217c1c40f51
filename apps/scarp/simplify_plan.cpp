#include "simplify_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "text.h"

namespace scarp::cli {
namespace {

Result<MeshFormat> choose_format(const SimplifyArguments& given) {
  if (given.output == "-") {
    return fail(ErrorKind::kUsage, "- is no output: for standard output give /dev/stdout and a format with --of");
  }
  if (given.format) {
    const std::optional<MeshFormat> named = find_mesh_format(*given.format);
    if (named && given.format->find_first_of("./") == std::string::npos) return *named;
    return fail(ErrorKind::kUsage,
                fmt::format("--of {} is unknown: choose glb, obj, ply or stl", shell_word(*given.format)));
  }
  const std::string extension = std::filesystem::path(given.output).extension().string();
  if (extension.size() > 1) {
    if (const std::optional<MeshFormat> named = find_mesh_format(extension.substr(1))) return *named;
  }
  return fail(ErrorKind::kUsage, fmt::format("{} does not tell a mesh format: end it in .glb, .obj, .ply or .stl, or "
                                             "choose one with --of",
                                             shell_word(given.output)));
}

Result<void> plan_goals(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (!given.max_error && !given.max_triangles && !given.max_points) {
    return fail(ErrorKind::kUsage,
                fmt::format("no goal is given: say how good the mesh must be, such as -e 1 for heights within 1 unit, "
                            "or how small with -t or -p; 'scarp info {}' suggests errors",
                            shell_word(given.raster.path)));
  }
  if (given.max_error) {
    const Result<ErrorGoal> goal = parse_error_goal("--max-error", *given.max_error);
    if (!goal) return tl::unexpected(goal.error());
    plan.error_goal = *goal;
  }
  if (given.max_triangles) {
    const Result<std::uint64_t> budget = parse_count("--max-triangles", *given.max_triangles, 1);
    if (!budget) return tl::unexpected(budget.error());
    plan.simplify.max_triangles = *budget;
  }
  if (given.max_points) {
    const Result<std::uint64_t> budget = parse_count("--max-points", *given.max_points, 1);
    if (!budget) return tl::unexpected(budget.error());
    plan.simplify.max_vertices = *budget;
  }
  return {};
}

Result<void> plan_nodata(const SimplifyArguments& given, SimplifyPlan& plan) {
  const std::string policy = given.nodata_policy.value_or("hole");
  if (policy == "fill") {
    plan.policy = NodataPolicy::kFill;
  } else if (policy == "background") {
    plan.policy = NodataPolicy::kBackground;
  } else if (policy != "hole") {
    return fail(ErrorKind::kUsage,
                fmt::format("--nodata-policy {} is unknown: choose hole, fill or background", shell_word(policy)));
  }
  if (given.fill_distance) {
    if (plan.policy != NodataPolicy::kFill) {
      return fail(ErrorKind::kUsage, "--fill-distance needs --nodata-policy fill");
    }
    const Result<double> distance = parse_number("--fill-distance", *given.fill_distance);
    if (!distance) return tl::unexpected(distance.error());
    if (*distance <= 0) {
      return fail(ErrorKind::kUsage, fmt::format("--fill-distance {} is not above 0", *given.fill_distance));
    }
    plan.fill_distance = *distance;
  }
  if (given.background.has_value() != (plan.policy == NodataPolicy::kBackground)) {
    return fail(ErrorKind::kUsage, given.background
                                       ? "--background needs --nodata-policy background"
                                       : "--nodata-policy background needs the height to use: --background V");
  }
  if (given.background) {
    const Result<double> height = parse_number("--background", *given.background);
    if (!height) return tl::unexpected(height.error());
    if (std::abs(*height) > std::numeric_limits<float>::max()) {
      return fail(ErrorKind::kUsage, fmt::format("--background {} does not fit a float", *given.background));
    }
    plan.background = static_cast<float>(*height);
  }
  if (given.outline_tolerance) {
    const Result<double> tolerance = parse_non_negative("--outline-tolerance", *given.outline_tolerance);
    if (!tolerance) return tl::unexpected(tolerance.error());
    plan.simplify.outline_tolerance = *tolerance;
  }
  return {};
}

Result<void> plan_outputs(const SimplifyArguments& given, SimplifyPlan& plan) {
  if (given.output.empty()) return fail(ErrorKind::kUsage, "the name of OUTPUT is empty");
  const Result<MeshFormat> format = choose_format(given);
  if (!format) return tl::unexpected(format.error());
  plan.format = *format;
  plan.simplify.normals = given.normals;
  plan.simplify.float32_positions = plan.format == MeshFormat::kGlb || plan.format == MeshFormat::kStl;
  if (given.base) {
    const Result<double> base = parse_number("--base", *given.base);
    if (!base) return tl::unexpected(base.error());
    constexpr double kFarthest = 1e30;  // differences to heights must fit float32
    if (std::abs(*base) > kFarthest) {
      return fail(ErrorKind::kUsage, fmt::format("--base {} is out of the range of float32 heights: choose one between "
                                                 "-1e30 and 1e30",
                                                 *given.base));
    }
    plan.base = *base;
  }
  if (given.normals && given.base) {
    return fail(ErrorKind::kUsage,
                "--normals and --base contradict each other: a solid's walls have no terrain normal");
  }
  if (given.normals && plan.format == MeshFormat::kStl) {
    plan.warnings.push_back("STL has no place for vertex normals: --normals changes nothing");
  }
  std::vector<PlannedOutput> outputs{{"OUTPUT", given.output}};
  if (given.preview) {
    outputs.push_back({"--preview", *given.preview});
    const Result<void> named = check_png_name(outputs.back());
    if (!named) return named;
  }
  if (given.report) outputs.push_back({"--report", *given.report});
  return check_outputs(outputs, {given.raster.path}, given.overwrite);
}

std::string canonical_command(const SimplifyArguments& given) {
  std::string command = "scarp simplify " + shell_word(base_name(given.raster.path)) + " OUTPUT";
  const std::pair<const char*, const Given*> options[] = {
      {"--max-error", &given.max_error},
      {"--max-triangles", &given.max_triangles},
      {"--max-points", &given.max_points},
      {"--band", &given.raster.band},
      {"--nodata", &given.raster.nodata},
      {"--decode", &given.raster.decode},
      {"--crs", &given.raster.crs},
      {"--nodata-policy", &given.nodata_policy},
      {"--fill-distance", &given.fill_distance},
      {"--background", &given.background},
      {"--outline-tolerance", &given.outline_tolerance},
      {"--base", &given.base},
  };
  for (const auto& [name, value] : options) {
    if (*value) command += fmt::format(" {} {}", name, shell_word(**value));
  }
  return given.normals ? command + " --normals" : command;
}

}  // namespace

Result<SimplifyPlan> plan_simplify(const SimplifyArguments& given) {
  SimplifyPlan plan;
  plan.input = given.raster.path;
  plan.output = given.output;
  plan.preview = given.preview;
  plan.report = given.report;
  plan.overwrite = given.overwrite;
  plan.canonical_command = canonical_command(given);

  const Result<ReadOptions> read = given.raster.parse();
  if (!read) return tl::unexpected(read.error());
  plan.read = *read;
  const Result<int> threads = parse_threads(given.threads);
  if (!threads) return tl::unexpected(threads.error());
  plan.simplify.threads = *threads;
  for (const auto step : {plan_goals, plan_nodata, plan_outputs}) {
    const Result<void> planned = step(given, plan);
    if (!planned) return tl::unexpected(planned.error());
  }
  return plan;
}

const char* format_name(MeshFormat format) {
  switch (format) {
    case MeshFormat::kGlb:
      return "glb";
    case MeshFormat::kObj:
      return "obj";
    case MeshFormat::kPly:
      return "ply";
    case MeshFormat::kStl:
      break;
  }
  return "stl";
}

}  // namespace scarp::cli
