// The one table of options: `--help`, `scarp help --json`, CLI11's registration, the man page, the completions and the
// page of all options are made from it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

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
inline constexpr Commands kEveryCommand = 8191;

struct OptionRow {
  OptionId id;
  const char* name;             ///< "--max-error"; "INPUT" for an argument without a name
  const char* short_name = "";  ///< "-e"
  Commands commands;
  OptionGroup group;
  OptionType type;
  const char* value = "";    ///< name of the value in help; empty: the choices
  const char* choices = "";  ///< words, separated by blanks
  const char* unit = "";
  const char* by_default = "";  ///< empty: the option does nothing unless it is given
  const char* range = "";
  bool is_repeatable = false;
  bool is_required = false;
  const char* help;        ///< one or two sentences; completions use the first
  const char* brief = "";  ///< one line for -h, where all options do not fit a screen; empty: not among them

  bool is_argument() const { return name[0] != '-'; }
  std::vector<std::string> list_choices() const;
  /// "M|P%", "hole|fill|background"; empty for a flag.
  std::string value_text() const;
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
/// The row of the option ("--max-error", "-e") if one of the commands has it; else null.
const OptionRow* find_option(Commands commands, std::string_view name);
/// Null if there is no such command.
const CommandRow* find_command(std::string_view name);

/// Registers the option as its row describes it. Throws std::logic_error if the command has no such row.
void add_option(CLI::App& command, OptionId id, std::string& value);
void add_option(CLI::App& command, OptionId id, std::optional<std::string>& value);
void add_option(CLI::App& command, OptionId id, std::vector<std::string>& values);
/// Arguments: as many as are given, but for the last one, which is another. Without `last`, all of them.
void add_arguments(CLI::App& command, OptionId id, std::vector<std::string>& values);
void add_arguments(CLI::App& command, OptionId id, std::vector<std::string>& values, OptionId last_id,
                   std::string& last);
/// An option with so many values.
void add_numbers(CLI::App& command, OptionId id, std::vector<std::string>& values, int count);
void add_flag(CLI::App& command, OptionId id, bool& value);
/// Every file that the command line names to be read, in the order of the table: the values of all rows of
/// OptionType::kInputFile, a layer behind a name included ("FILE:LAYER"), the number of a region ("=M") omitted.
std::vector<std::string> files_read(const CLI::App& command);
/// The command of the program, with its --version.
CLI::App* add_command(CLI::App& program, Commands command);

}  // namespace scarp::cli
