#include "door.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "options/option_table.h"
#include "scarp/version.h"
#include "terminal/clock.h"
#include "terminal/text.h"
#include "terminal/time_left.h"

namespace scarp::door {
namespace {

constexpr const char* kNoMemory = "out of memory";  // so short that a string holds it without asking for more

std::string& last_sentence() {
  thread_local std::string sentence;
  return sentence;
}

bool is_option(const std::string& name) { return cli::find_option(cli::kEveryCommand, name) != nullptr; }

template <class T>
void init(T* out, std::uint32_t size, T all) {
  if (out == nullptr) return;
  all.struct_size = size;
  std::memcpy(out, &all, std::min<std::size_t>(size, sizeof all));
}

}  // namespace

std::string in_words_of_door(const std::string& sentence) {
  std::string text;
  for (std::size_t at = 0; at < sentence.size();) {
    std::size_t end = at;
    if (sentence.compare(at, 2, "--") == 0 && (at == 0 || sentence[at - 1] != '-'))
      end = std::min(sentence.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at + 2), sentence.size());
    if (end > at + 2 && is_option(sentence.substr(at, end - at))) {
      std::string name = sentence.substr(at + 2, end - at - 2);
      std::replace(name.begin(), name.end(), '-', '_');
      text += name;
      at = end;
    } else {
      text += sentence[at++];
    }
  }
  return text;
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
