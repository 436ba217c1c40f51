#include "door.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "scarp/version.h"
#include "session/table/option_table.h"
#include "session/text/clock.h"
#include "session/text/text.h"
#include "session/text/time_left.h"
#include "settings.h"

namespace scarp::door {
namespace {

constexpr const char* kNoMemory = "out of memory";  // short enough for a string without allocation

std::string& last_sentence() {
  thread_local std::string sentence;
  return sentence;
}

/// Names of options that differ from the program's; set before other calls.
std::map<cli::OptionId, std::string>& names_here() {
  static std::map<cli::OptionId, std::string> names{{cli::OptionId::kThreads, "threads"}};
  return names;
}

bool is_of_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '_';
}

/// The option that begins at a dash, "--max-error" or "-e", and the end of its name; null if there is none. Letters
/// after another program's name are that program's option.
const cli::OptionRow* option_at(const std::string& sentence, std::size_t at, std::size_t& end) {
  if (sentence[at] != '-' || (at > 0 && is_of_name(sentence[at - 1]))) return nullptr;
  end = at;
  while (end < sentence.size() && is_of_name(sentence[end])) ++end;
  if (end == at + 2 && end + 1 < sentence.size() && sentence[end] == '.' && is_of_name(sentence[end + 1]))
    return nullptr;
  const std::string clause = sentence.substr(0, at);
  if (end == at + 2 && clause.find("gdal", clause.find_last_of("('") + 1) != std::string::npos) return nullptr;
  for (const cli::OptionRow* row : cli::rows_of(cli::kEveryCommand)) {  // "--cutline inset"
    const std::string title = row->title();
    const bool is_there = row->part_of != cli::OptionId::kNone && sentence.compare(at, title.size(), title) == 0;
    if (!is_there || (at + title.size() < sentence.size() && is_of_name(sentence[at + title.size()]))) continue;
    end = at + title.size();
    return row;
  }
  return cli::find_option(cli::kEveryCommand, sentence.substr(at, end - at));
}

std::string name_here(const cli::OptionRow& row) {
  const auto named = names_here().find(row.id);
  if (named != names_here().end()) return named->second;
  std::string name = std::string(row.name).substr(2);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

template <class T>
void init(T* out, std::uint32_t size, T all) {
  if (out == nullptr) return;
  all.struct_size = size;
  std::memcpy(out, &all, std::min<std::size_t>(size, sizeof all));
}

}  // namespace

std::string in_words_of_door(const std::string& sentence) {
  std::string text;
  for (std::size_t at = 0, end = 0; at < sentence.size();) {
    if (const cli::OptionRow* const row = option_at(sentence, at, end)) {
      text += name_here(*row);
      at = end;
    } else {
      text += sentence[at++];
    }
  }
  return text;
}

Result<void> name_option(const std::string& name, const std::string& shown) {
  const cli::OptionRow* const row = cli::find_option(cli::kEveryCommand, name);
  if (row == nullptr) return fail(ErrorKind::kUsage, "no option is called " + name);
  names_here()[row->id] = shown;
  return {};
}

std::string find_named_here(const std::string& name) {
  const auto named =
      std::find_if(names_here().begin(), names_here().end(), [&](const auto& entry) { return entry.second == name; });
  if (named == names_here().end()) return "";
  const auto rows = cli::rows_of(cli::kEveryCommand);
  return (*std::find_if(rows.begin(), rows.end(), [&](const auto* row) { return row->id == named->first; }))->name;
}

scarp_status report(const Error& error) {
  try {
    last_sentence() = in_words_of_door(error.message);
  } catch (...) {
    last_sentence() = kNoMemory;
  }
  return cli::exit_code(error.kind);
}

scarp_status report(ErrorKind kind, const std::string& sentence) { return report(Error{kind, sentence}); }

scarp_status report_exception() {
  try {
    throw;
  } catch (const Refused& refused) {
    return report(refused.error);
  } catch (const std::bad_alloc&) {
    last_sentence() = kNoMemory;
    return SCARP_INPUT;
  } catch (const std::exception& error) {
    return report(ErrorKind::kInternal, std::string("internal error: ") + error.what() + "; please report it");
  } catch (...) {
    return report(ErrorKind::kInternal, "internal error: an unknown exception; please report it");
  }
}

ProgressCallback progress_of(const scarp_options& asked, const cli::TileCounts* counts) {
  if (asked.progress == nullptr) return {};
  return [tell = asked.progress, user = asked.user, counts, pass = std::string(),
          start = cli::Clock::time_point()](const Progress& progress) mutable {
    if (pass != progress.pass) {
      pass = progress.pass;
      start = cli::Clock::now();
    }
    scarp_progress told{};
    told.struct_size = sizeof told;
    told.pass = pass.c_str();
    told.fraction = progress.fraction;
    told.vertices = progress.vertices;
    told.max_error = progress.max_error;
    told.seconds_left = cli::find_seconds_left(cli::seconds_since(start), progress.fraction)
                            .value_or(std::numeric_limits<double>::quiet_NaN());
    if (counts != nullptr) {
      told.tiles = counts->tiles;
      told.bytes = counts->bytes;
    }
    return tell(&told, user) == 0;
  };
}

}  // namespace scarp::door

using scarp::door::init;

extern "C" {

uint32_t scarp_abi_version(void) { return SCARP_ABI_VERSION; }
const char* scarp_version(void) { return scarp::version(); }
const char* scarp_last_error(void) { return scarp::door::last_sentence().c_str(); }

scarp_status scarp_name_option(const char* name, const char* shown) {
  return scarp::door::guarded([&]() -> scarp_status {
    if (name == nullptr || shown == nullptr)
      return scarp::door::report(scarp::ErrorKind::kUsage, "a name of the option is a null pointer");
    auto named = scarp::door::name_option(scarp::door::name_in_program(name), shown);
    return named ? SCARP_OK : scarp::door::report(named.error());
  });
}

void scarp_field_init(scarp_field* field, uint32_t struct_size) {
  scarp_field all{};
  all.nodata = std::numeric_limits<double>::quiet_NaN();
  all.geotransform[1] = 1;
  all.geotransform[5] = -1;
  init(field, struct_size, all);
}

void scarp_points_init(scarp_points* points, uint32_t struct_size) {
  scarp_points all{};
  all.stride = 1;
  init(points, struct_size, all);
}

void scarp_options_init(scarp_options* options, uint32_t struct_size) {
  scarp_options all{};
  all.max_error = std::numeric_limits<double>::quiet_NaN();
  init(options, struct_size, all);
}

}  // extern "C"
