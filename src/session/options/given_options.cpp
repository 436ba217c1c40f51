#include "session/options/given_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/alike.h"
#include "scarp/version.h"
#include "session/options/option_rules.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using Rows = std::vector<const OptionRow*>;

/// The parts of the option's value that the command allows.
Rows parts_of(Commands command, OptionId id) {
  Rows parts;
  for (const OptionRow* row : accepted_rows(command)) {
    if (row->part_of == id) parts.push_back(row);
  }
  return parts;
}

/// The part whose ",key=" or ",key" begins the text, or null.
const OptionRow* find_part(const Rows& parts, std::string_view text) {
  for (const OptionRow* part : parts) {
    const std::string_view key = part->key;
    if (!text.starts_with(key)) continue;
    const char behind = text.size() > key.size() ? text[key.size()] : ',';
    if (behind == '=' || (part->type == OptionType::kFlag && behind == ',')) return part;
  }
  return nullptr;
}

/// The start of the next part, at `from` or after a comma; the end of the text if none.
std::size_t find_next_part(const Rows& parts, std::string_view text, std::size_t from) {
  for (std::size_t at = from; at < text.size(); ++at) {
    const bool may_begin = at == 0 || text[at - 1] == ',';
    if (may_begin && find_part(parts, text.substr(at)) != nullptr) return at;
  }
  return text.size();
}

/// True if the only "=M" in a region's value is at `equals`, and `key` does not resemble a part's key.
bool is_in_name(const Rows& parts, const std::string& text, std::size_t equals, const std::string& key) {
  constexpr std::size_t kMostTypos = 2;
  return text.find('=') == equals && std::none_of(parts.begin(), parts.end(), [&](const OptionRow* part) {
           return count_typos(part->key, key) <= kMostTypos;
         });
}

/// Fails for an unknown key, such as ",inser=2", in a value without its parts.
Result<void> check_keys(const OptionRow& row, const Rows& parts, const std::string& text) {
  const std::size_t comma = text.rfind(','), equals = text.find('=', comma);
  if (comma == std::string::npos || equals == std::string::npos) return {};
  const std::string key = text.substr(comma + 1, equals - comma - 1);
  if (key.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos) return {};
  if (row.id == kRoi && is_in_name(parts, text, equals, key)) return {};
  std::string known;
  for (const OptionRow* part : parts)
    known += (known.empty() ? "" : part == parts.back() ? " or " : ", ") + std::string(part->key);
  return fail(ErrorKind::kUsage, fmt::format("{} has no key {}: choose {}", row.name, shell_word(key), known));
}

/// Parses a number in the row's range.
Result<double> judge(const OptionRow& row, const std::string& text) {
  const std::string name = row.title();
  const auto refuse = [&](std::string what) {
    if (row.limit_why[0] != 0) what += std::string(": ") + row.limit_why;
    return fail(ErrorKind::kUsage, fmt::format("{} {} {}", name, shell_word(text), what));
  };
  SCARP_TRY(const double value, parse_number(name, text));
  if (value < 0 && row.least == 0) return refuse("is negative: it must be at least 0");
  if (value < row.least) return refuse(fmt::format("is below {}", row.least));
  if (!(value > row.above)) return refuse(fmt::format("is not above {}", row.above));
  if (value > row.most) return refuse(fmt::format("is above {}", row.most));
  return value;
}

}  // namespace

void GivenOptions::add_row(CLI::App& command, const OptionRow& row) {
  Entry& entry = this->entry(row.id);
  const std::string names = std::string(row.short_name) + (row.short_name[0] != 0 ? "," : "") + row.name;
  if (row.id == kHelp || row.id == kHelpAll || row.id == kVersion) return;  // CLI11 has them built in
  if (row.type == OptionType::kFlag) {
    command.add_flag(names, entry.is_given);
  } else if (row.is_repeatable || row.value_count() > 1) {
    CLI::Option* const option = command.add_option(names, entry.texts)->required(row.is_required);
    if (row.value_count() > 1)
      option->expected(row.value_count());
    else if (!row.is_argument())
      option->allow_extra_args(false);  // one value per occurrence of the option
  } else {
    command.add_option(names, entry.text)->required(row.is_required);
  }
}

CLI::App* GivenOptions::add_to(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(command_name(command_));
  command->set_version_flag("--version", fmt::format("scarp {}", scarp::version()));
  OptionId several = kNone, last = kNone;  // CLI11 passes all arguments to the first row that accepts several
  for (const OptionRow* row : accepted_rows(command_)) {
    add_row(*command, *row);
    if (!row->is_argument()) continue;
    if (several != kNone) {
      last = row->id;
      command->get_option(row->name)->required(false);
    }
    if (row->is_repeatable) several = row->id;
  }
  command->parse_complete_callback([this, several, last] {
    if (std::vector<std::string>& texts = entry(several).texts; last != kNone && !texts.empty()) {
      if (texts.size() == 1) throw CLI::RequiredError(name_of(last));
      entry(last).text = std::move(texts.back());
      texts.pop_back();
    }
    if (const Result<void> settled = settle(); !settled) throw CLI::ValidationError(settled.error().message);
  });
  return command;
}

GivenOptions GivenOptions::as(Commands command) const {
  GivenOptions other = *this;
  other.command_ = command;
  return other;
}

void GivenOptions::set(OptionId id, Given text) { entry(id) = Entry{text.has_value(), std::move(text), {}}; }

void GivenOptions::set(OptionId id, Texts texts) { entry(id) = Entry{!texts.empty(), std::nullopt, std::move(texts)}; }

Result<void> GivenOptions::separate_parts() {
  for (const OptionRow* row : accepted_rows(command_)) {
    Entry& whole = entry(row->id);
    std::vector<std::string*> texts;
    for (std::string& text : whole.texts) texts.push_back(&text);
    if (whole.text) texts.push_back(&*whole.text);
    const Rows parts = texts.empty() ? Rows() : parts_of(command_, row->id);
    if (parts.empty()) continue;
    bool emptied = false;
    for (std::string* const text : texts) {
      const std::size_t first = find_next_part(parts, *text, 0);
      if (text->empty()) continue;
      for (std::size_t at = first; at < text->size();) {
        const OptionRow& part = *find_part(parts, std::string_view(*text).substr(at));
        const std::size_t end = find_next_part(parts, *text, at + 1);
        std::string value = text->substr(at, end - at);
        if (end < text->size()) value.pop_back();
        const std::size_t equals = value.find('=');
        if (part.type == OptionType::kFlag && equals != std::string::npos)
          return fail(ErrorKind::kUsage, fmt::format("{} has no value: omit {}", part.id, value.substr(equals)));
        if (has(part.id) || entry(part.id).text)
          return fail(ErrorKind::kUsage, fmt::format("{} is given more than once", part.id));
        entry(part.id) = Entry{true, {}, {}};
        if (part.type != OptionType::kFlag) entry(part.id).text = value.substr(equals + 1);
        at = end;
      }
      if (first < text->size()) text->resize(first > 0 ? first - 1 : 0);
      SCARP_RETURN_IF_ERROR(check_keys(*row, parts, *text));
      if (first == 0 && text->empty()) emptied = true;  // "--water flats=200" names no file
    }
    if (emptied && whole.text) whole.text.reset();
    if (emptied) std::erase(whole.texts, "");
  }
  return {};
}

Result<void> GivenOptions::settle() {
  SCARP_RETURN_IF_ERROR(separate_parts());
  for (const OptionRow* row : accepted_rows(command_)) {
    Entry& one = entry(row->id);
    if (row->type != OptionType::kFlag) one.is_given = one.text || !one.texts.empty();
  }
  return check_rules(command_, *this, false);
}

Result<std::optional<double>> GivenOptions::number(OptionId id) const {
  const Given& text = (*this)[id];
  if (!text) return std::optional<double>();
  SCARP_TRY(const double value, judge(*find_option(command_, id), *text));
  return std::optional(value);
}

Result<std::optional<std::uint64_t>> GivenOptions::count(OptionId id) const {
  const Given& text = (*this)[id];
  if (!text) return std::optional<std::uint64_t>();
  const OptionRow& row = *find_option(command_, id);
  SCARP_TRY(const std::uint64_t value,
            parse_count(name_of(id), *text, row.least > 0 ? static_cast<std::uint64_t>(row.least) : 0));
  if (static_cast<double>(value) > row.most) {
    SCARP_RETURN_IF_ERROR(judge(row, fmt::format("{}", value)));
  }
  return std::optional(value);
}

Result<int> GivenOptions::threads() const {
  SCARP_TRY(const std::optional<std::uint64_t> threads, count(kThreads));
  return static_cast<int>(threads.value_or(0));
}

const std::vector<std::string>& GivenOptions::inputs() const {
  return all(kInput).empty() ? all(kRaster) : all(kInput);
}

std::optional<OptionId> GivenOptions::first_of(std::initializer_list<OptionId> ids) const {
  for (const OptionId id : ids) {
    if (has(id)) return id;
  }
  return std::nullopt;
}

std::vector<const OptionRow*> GivenOptions::given() const {
  Rows rows = accepted_rows(command_);
  std::erase_if(rows, [&](const OptionRow* row) { return row->is_argument() || !has(row->id); });
  return rows;
}

std::vector<std::string> GivenOptions::files_read() const {
  std::vector<std::string> files;
  for (const OptionRow* row : accepted_rows(command_)) {
    if (row->type != OptionType::kInputFile) continue;
    std::vector<std::string> values = all(row->id);
    if ((*this)[row->id]) values.push_back(*(*this)[row->id]);
    for (std::string& value : values) {
      if (std::string_view(row->value).ends_with("=M")) value.resize(std::min(value.rfind('='), value.size()));
      files.push_back(std::move(value));
    }
  }
  return files;
}

std::string GivenOptions::canonical(const OptionRow& row, const std::vector<const OptionRow*>& rows) const {
  const auto bare = [&](const std::string& text) {
    return row.type == OptionType::kInputFile ? base_name(text) : text;
  };
  std::vector<std::string> values;
  for (const std::string& text : all(row.id)) values.push_back(bare(text));
  if (const Given& text = (*this)[row.id]; text && *text != row.by_default) values.push_back(bare(*text));
  std::string parts;
  for (const OptionRow* part : rows) {
    if (part->part_of != row.id || !has(part->id) || !part->is_of_mesh) continue;
    parts += std::string(",") + part->key + (part->type == OptionType::kFlag ? "" : "=" + *(*this)[part->id]);
  }
  if (!parts.empty() && values.empty()) values.push_back((*this)[row.id].value_or(""));
  if (!parts.empty()) values.back() += values.back().empty() ? parts.substr(1) : parts;
  if (row.value_count() > 1 && !values.empty()) return fmt::format(" {} {}", row.name, fmt::join(values, " "));
  std::string text;
  for (const std::string& value : values) text += fmt::format(" {} {}", row.name, shell_word(value));
  return row.type == OptionType::kFlag && has(row.id) ? fmt::format(" {}", row.name) : text;
}

std::string GivenOptions::canonical() const {
  std::string text;
  const Rows rows = accepted_rows(command_);
  for (const OptionRow* row : rows) {
    if (row->is_argument() || !row->is_of_mesh || row->part_of != kNone) continue;
    text += canonical(*row, rows);
  }
  return text;
}

}  // namespace scarp::cli
