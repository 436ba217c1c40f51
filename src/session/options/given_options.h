// The options of one command line: registered, parsed, validated and spelled canonically by the table.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/result.h"
#include "session/options/values.h"
#include "session/table/option_table.h"

namespace CLI {
class App;
}

namespace scarp::cli {

class GivenOptions {
 public:
  using Texts = std::vector<std::string>;

  explicit GivenOptions(Commands command) : command_(command) {}

  /// Adds the command to the program, with all its options. Parsing writes to *this, which must not move. Parsing ends
  /// with a check of the table's rules (option_rules.h), which throws CLI::ParseError.
  CLI::App* add_to(CLI::App& program);

  Commands command() const { return command_; }
  bool has(OptionId id) const { return entry(id).is_given; }
  /// The value; nothing if the option was not given or is repeatable.
  const Given& operator[](OptionId id) const { return entry(id).text; }
  /// All values of an option that is repeatable or has several values.
  const std::vector<std::string>& all(OptionId id) const { return entry(id).texts; }
  /// Forgets all values, before another parse.
  void clear() { entries_ = {}; }
  /// The same options for another command.
  GivenOptions as(Commands command) const;
  /// Sets or removes the option's value.
  void set(OptionId id, Given text);
  void set(OptionId id, Texts texts);

  /// The option's number, checked against its row's range; nothing if not given.
  Result<std::optional<double>> number(OptionId id) const;
  Result<std::optional<std::uint64_t>> count(OptionId id) const;
  /// The value that the word stands for.
  template <class T, std::size_t N>
  Result<std::optional<T>> choice(OptionId id, const Choice<T> (&choices)[N]) const {
    const Given& text = (*this)[id];
    if (!text) return std::optional<T>();
    SCARP_TRY(const T value, choose(name_of(id), *text, choices));
    return std::optional(value);
  }
  /// Number of threads, up to 1024; 0, the default: all cores.
  Result<int> threads() const;

  /// The rasters, points or tilesets that the command reads. Never empty after parsing a command that needs one.
  const std::vector<std::string>& inputs() const;
  const std::string& input() const { return inputs().front(); }
  /// The first of these options that was given; nothing if none was given.
  std::optional<OptionId> first_of(std::initializer_list<OptionId> ids) const;
  /// Every option that was given, except arguments, in the order of the table.
  std::vector<const OptionRow*> given() const;
  /// Every input file that options name, in the order of the table, with its layer ("FILE:LAYER") but without the
  /// tolerance of a region ("=M").
  std::vector<std::string> files_read() const;
  /// " --max-error 1 --cutline site.gpkg,inset=2": all options that can change the mesh, in the order of the table,
  /// without folders of files and without defaults.
  std::string canonical() const;

 private:
  struct Entry {
    bool is_given = false;
    Given text;
    std::vector<std::string> texts;
  };

  const Entry& entry(OptionId id) const { return entries_[static_cast<std::size_t>(id)]; }
  Entry& entry(OptionId id) { return entries_[static_cast<std::size_t>(id)]; }
  void add_row(CLI::App& command, const OptionRow& row);
  /// Moves parts of a value such as "FILE,inset=2" to their own entries.
  Result<void> separate_parts();
  Result<void> settle();
  std::string canonical(const OptionRow& row, const std::vector<const OptionRow*>& rows) const;

  Commands command_;
  std::array<Entry, static_cast<std::size_t>(OptionId::kNone)> entries_;
};

}  // namespace scarp::cli
