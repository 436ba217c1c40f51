// The one table of options. Registration, parsing, ranges, the canonical command, `--help`, `scarp help --json`, the
// man page, the completions, the page of all options and the settings of C and Python are made from it.
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
  kLayer,
  kZField,
  kColumns,
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
  kNone,  ///< no option; their number
};

/// In the order in which help lists them.
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
  kNumber,      ///< a number, perhaps with a unit behind it
  kCount,       ///< a whole number
  kText,        ///< any text; `choices` are proposals
  kChoice,      ///< one of `choices`
  kInputFile,   ///< the run reads it; `choices` are the endings of its name, if not any will do
  kOutputFile,  ///< the run writes it
  kFolder,
};

/// Commands as bits, so that a row can belong to several.
using Commands = unsigned;
inline constexpr Commands kSimplify = 1, kMeasure = 2, kInfo = 4, kGenerate = 8, kHelpCommand = 16,
                          kVersionCommand = 32, kTile = 64, kServe = 128, kTilePlan = 256, kTileRun = 512,
                          kTileFinish = 1024, kTileCheck = 2048, kView = 4096;
/// The options that `scarp classic` has in addition to those of simplify, which accepts them, too, until 0.4.
inline constexpr Commands kStrategies = 8192;
inline constexpr Commands kClassic = kSimplify | kStrategies;
inline constexpr Commands kEveryCommand = 16383;

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct OptionRow {
  OptionId id;
  const char* name;             ///< "--max-error"; "INPUT" for an argument without a name
  const char* short_name = "";  ///< "-e"
  /// The option whose value this is a KEY=VALUE of: `--cutline FILE,inset=2`. Its own name is the spelling of 0.2.
  OptionId part_of = OptionId::kNone;
  const char* key = "";
  Commands commands;
  OptionGroup group;
  OptionType type;
  const char* value = "";    ///< name of the value in help; empty: the choices
  const char* choices = "";  ///< words, separated by blanks
  const char* unit = "";
  const char* by_default = "";  ///< empty: the option does nothing unless it is given
  double least = -kNoLimit;     ///< the least number
  double above = -kNoLimit;     ///< the number that all are above
  double most = kNoLimit;       ///< the largest number
  const char* limit_why = "";   ///< reason of a limit, for the sentence that refuses a number beyond it
  const char* range = "";       ///< in words, where the three above do not express it
  bool is_repeatable = false;
  bool is_required = false;
  bool is_of_mesh = true;      ///< can change the mesh: stands in the canonical command
  bool is_for_points = false;  ///< holds where the input is scattered points, too
  const char* help;            ///< one or two sentences; completions use the first
  const char* brief = "";      ///< one line for -h, where all options do not fit a screen; empty: not among them

  bool is_argument() const { return name[0] != '-'; }
  std::vector<std::string> list_choices() const;
  /// "M|P%", "hole|fill|background"; empty for a flag.
  std::string value_text() const;
  /// "0 to 33", "above 0"; empty if any value will do.
  std::string range_text() const;
  /// "--cutline inset" for a part, else the name.
  std::string title() const;
  /// How many values follow the name: 4 for "XMIN YMIN XMAX YMAX".
  int value_count() const;
};

/// An option, or one of its values.
struct OptionTerm {
  OptionId id = OptionId::kNone;
  const char* value = "";  ///< empty: any; "!hole": any but hole
};

struct CommandRow {
  Commands command;  ///< one bit
  const char* name;
  const char* summary;
  const char* usage;  ///< behind the name
  const char* notes;  ///< examples and exit codes, ends of lines included
};

struct GroupRow {
  OptionGroup group;
  const char* name;
  const char* note;  ///< behind the name where help lists the group; may be empty
};

std::span<const CommandRow> command_rows();
std::span<const GroupRow> group_rows();
/// Every row that the command has, in the order in which help lists them.
std::vector<const OptionRow*> rows_of(Commands command);
/// The same, and those that it accepts as they were spelled earlier.
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
/// The option as sentences name it: "--max-error", "--cutline inset".
const std::string& name_of(OptionId id);

}  // namespace scarp::cli

/// An option is printed by its name.
template <>
struct fmt::formatter<scarp::cli::OptionId> : fmt::formatter<std::string_view> {
  auto format(scarp::cli::OptionId id, fmt::format_context& context) const {
    return fmt::formatter<std::string_view>::format(scarp::cli::name_of(id), context);
  }
};
