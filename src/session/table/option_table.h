// The only table of options. It defines registration, parsing, ranges, the canonical command, `--help`, `scarp help
// --json`, the man page, the completions, the page of all options and the settings of C, Python and the npm package.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scarp::cli {

enum class OptionId {
  kInput,
  kOutput,
  kRaster,
  kMesh,
  kStyle,
  kCols,
  kRows,
  kCommand,
  kMaxError,
  kMaxTriangles,
  kMaxPoints,
  kObjective,
  kFailAbove,
  kVolume,
  kBand,
  kExtent,
  kResolution,
  kDecode,
  kCrs,
  kZScale,
  kZOffset,
  kZUnit,
  kCellSize,
  kUp,
  kDouble,
  kOf,
  kNormals,
  kUvs,
  kCompress,
  kDrape,
  kDrapeSize,
  kDrapeFormat,
  kNormalMap,
  kPreview,
  kRender,
  kErrorRaster,
  kHtml,
  kContoursOut,
  kContourInterval,
  kPage,
  kOpen,
  kMap,
  kReport,
  kJson,
  kOverwrite,
  kEffort,
  kVertices,
  kMinShape,
  kTimeLimit,
  kNodata,
  kNodataPolicy,
  kFillDistance,
  kBackground,
  kOutlineTolerance,
  kLods,
  kLodsInOne,
  kLockBorder,
  kMask,
  kTolerance,
  kRoi,
  kFalloff,
  kScript,
  kBreaklines,
  kBreaklineZ,
  kSoftBreaklines,
  kLineConflict,
  kCutline,
  kInset,
  kMaskOutside,
  kCliff,
  kRidges,
  kKeepRidges,
  kMaterials,
  kMaterialField,
  kNodeStrings,
  kWater,
  kWaterMask,
  kWaterPercentile,
  kDetectFlats,
  kRivers,
  kMinAngle,
  kMaxEdge,
  kGrade,
  kMinEdge,
  kBase,
  kSolid,
  kSplit,
  kTexture,
  kTextureWeight,
  kImage,
  kNorm,
  kChannelWeights,
  kPoints,
  kDuplicates,
  kDespike,
  kLayer,
  kZField,
  kColumns,
  kClass,
  kReturns,
  kBoundary,
  kImportance,
  kOnePass,
  kOrder,
  kAlgorithm,
  kBatch,
  kEdges,
  kEdgeScore,
  kShapeThreshold,
  kSupersample,
  kSeed,
  kRange,
  kSize,
  kNoSuggest,
  kQuality,
  kGrid,
  kZoom,
  kCells,
  kVertical,
  kGeoid,
  kEllipsoid,
  kPlan,
  kOnly,
  kBound,
  kMaxTileBytes,
  kChangedSince,
  kHash,
  kSurvey,
  kShard,
  kShards,
  kParts,
  kSlurm,
  kSource,
  kPort,
  kHost,
  kMemory,
  kThreads,
  kQuiet,
  kTiming,
  kJsonProgress,
  kHelp,
  kHelpAll,
  kAll,
  kVersion,
  kNone,  ///< no option; also the number of options
};

/// In the order of the help.
enum class OptionGroup {
  kArguments,
  kGoals,
  kVerdict,
  kField,
  kInput,
  kOutput,
  kEffort,
  kLevels,
  kNodata,
  kWhereItMatters,
  kLines,
  kWater,
  kShape,
  kSolids,
  kMemory,
  kRun,
  kTextures,
  kPoints,
  kStrategies,
};

enum class OptionType {
  kFlag,        ///< has no value
  kNumber,      ///< a number, possibly followed by a unit
  kCount,       ///< a whole number
  kText,        ///< any text; `choices` are suggestions
  kChoice,      ///< one of `choices`
  kInputFile,   ///< a file that the run reads; `choices` are its endings, if restricted
  kOutputFile,  ///< a file that the run writes
  kFolder,
};

/// Commands as bits, so that a row can belong to several.
using Commands = unsigned;
inline constexpr Commands kSimplify = 1, kMeasure = 2, kInfo = 4, kGenerate = 8, kHelpCommand = 16,
                          kVersionCommand = 32, kTile = 64, kServe = 128, kTilePlan = 256, kTileRun = 512,
                          kTileFinish = 1024, kTileCheck = 2048, kView = 4096;
/// The options that only `scarp classic` has; simplify also accepts them until 0.4.
inline constexpr Commands kStrategies = 8192;
inline constexpr Commands kClassic = kSimplify | kStrategies;
inline constexpr Commands kEveryCommand = 16383;

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct OptionRow {
  OptionId id;
  const char* name;             ///< "--max-error"; "INPUT" for an argument without a name
  const char* short_name = "";  ///< "-e"
  /// The option whose value contains this KEY=VALUE: `--cutline FILE,inset=2`. `name` is the spelling of 0.2.
  OptionId part_of = OptionId::kNone;
  const char* key = "";
  Commands commands;
  OptionGroup group;
  OptionType type;
  const char* value = "";    ///< name of the value in help; empty: the choices
  const char* choices = "";  ///< words, separated by blanks
  const char* unit = "";
  const char* by_default = "";  ///< empty: the option has no effect unless given
  double least = -kNoLimit;     ///< inclusive lower limit
  double above = -kNoLimit;     ///< exclusive lower limit
  double most = kNoLimit;       ///< inclusive upper limit
  const char* limit_why = "";   ///< reason for a limit, in errors
  const char* range = "";       ///< range in words, if the limits do not express it
  bool is_repeatable = false;
  bool is_required = false;
  bool is_of_mesh = true;      ///< can change the mesh: part of the canonical command
  bool is_for_points = false;  ///< also valid for scattered points
  const char* help;            ///< one or two sentences; completions use the first
  const char* brief = "";      ///< line of -h if the full help exceeds a screen; empty: omitted there

  bool is_argument() const { return name[0] != '-'; }
  std::vector<std::string> list_choices() const;
  /// "M|P%", "hole|fill|background"; empty for a flag.
  std::string value_text() const;
  /// "0 to 33", "above 0"; empty without limits.
  std::string range_text() const;
  /// "--cutline inset" for a part, else the name.
  std::string title() const;
  /// Number of values after the name: 4 for "XMIN YMIN XMAX YMAX".
  int value_count() const;
};

/// An option or one of its values.
struct OptionTerm {
  OptionId id = OptionId::kNone;
  const char* value = "";  ///< empty: any; "!hole": any but hole
};

struct CommandRow {
  Commands command;  ///< one bit
  const char* name;
  const char* summary;
  const char* usage;  ///< follows the name
  const char* notes;  ///< examples and exit codes, with line ends
};

struct GroupRow {
  OptionGroup group;
  const char* name;
  const char* note;  ///< follows the name in help; may be empty
};

std::span<const CommandRow> command_rows();
std::span<const GroupRow> group_rows();
/// The rows of the command, in the order of the help.
std::vector<const OptionRow*> rows_of(Commands command);
/// The command's rows, and rows that it accepts by earlier spellings.
std::vector<const OptionRow*> accepted_rows(Commands command);
/// The row of the option ("--max-error", "-e") if one of the commands has it; else null.
const OptionRow* find_option(Commands commands, std::string_view name);
/// The row of the option if one of the commands accepts it; else null.
const OptionRow* find_option(Commands commands, OptionId id);
/// Null if there is no such command.
const CommandRow* find_command(std::string_view name);
/// "--vertices free".
std::string name_of(const OptionTerm& term);
/// "tile-plan".
const char* command_name(Commands command);
/// The word for the type in `scarp help --json`.
const char* type_name(OptionType type);
/// The option's name in messages: "--max-error", "--cutline inset".
const std::string& name_of(OptionId id);

}  // namespace scarp::cli

/// Prints an option by its name.
template <>
struct fmt::formatter<scarp::cli::OptionId> : fmt::formatter<std::string_view> {
  auto format(scarp::cli::OptionId id, fmt::format_context& context) const {
    return fmt::formatter<std::string_view>::format(scarp::cli::name_of(id), context);
  }
};
