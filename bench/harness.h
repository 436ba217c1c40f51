// Common parts of all benchmarks in C++: command lines, clocks, rasters by name, tables.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace bench {

[[noreturn]] inline void die(const std::string& sentence, int code = 2) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  std::exit(code);
}

/// The value of a scarp::Result; exits with its error.
template <class Outcome>
auto check(Outcome result) {
  if (!result) die(result.error().message);
  return std::move(*result);
}

/// A command line, described by its usage: `PROGRAM NEEDED... [MORE] [--option VALUE] [--other A B]`. Exits with the
/// usage if the command line does not match. An option whose last value ends with "..." gets all following words.
class Arguments {
 public:
  Arguments(int argc, char** argv, const std::string& usage) {
    std::map<std::string, std::size_t> values_of;
    std::size_t needed = 0, most = 0;
    std::istringstream words(usage);
    std::string word, option;
    for (words >> word; words >> word;) {
      const bool is_open = word.front() == '[', is_rest = word.find("...") != std::string::npos;
      if (is_open && word.compare(1, 2, "--") == 0) {
        option = word.substr(1);
        values_of[option] = 0;
      } else if (!option.empty()) {
        values_of[option] = is_rest ? kAll : values_of[option] + 1;
        if (word.back() == ']') option.clear();
      } else {
        needed += is_open ? 0 : 1;
        most = is_rest ? kAll : most + 1;
      }
    }
    for (int k = 1; k < argc; ++k) {
      const auto found = values_of.find(argv[k]);
      if (found == values_of.end()) {
        words_.emplace_back(argv[k]);
        if (words_.back().compare(0, 2, "--") == 0) die("usage: " + usage, 1);
        continue;
      }
      std::vector<std::string>& values = options_[argv[k]];
      for (std::size_t v = 0; v < found->second && k + 1 < argc; ++v) values.emplace_back(argv[++k]);
      if (values.empty() || (found->second != kAll && values.size() < found->second)) die("usage: " + usage, 1);
    }
    if (words_.size() < needed || words_.size() > most) die("usage: " + usage, 1);
  }

  std::size_t count() const { return words_.size(); }
  const std::string& operator[](std::size_t k) const { return words_[k]; }
  double number(std::size_t k) const { return std::atof(words_[k].c_str()); }
  /// The words from the k-th on.
  std::vector<std::string> from(std::size_t k) const {
    return {words_.begin() + static_cast<std::ptrdiff_t>(k), words_.end()};
  }

  bool has(const std::string& option) const { return options_.count(option) != 0; }
  std::vector<std::string> values(const std::string& option) const {
    return has(option) ? options_.at(option) : std::vector<std::string>{};
  }
  std::string value(const std::string& option, const std::string& otherwise) const {
    return has(option) ? options_.at(option).front() : otherwise;
  }
  template <class Number>
  Number number(const std::string& option, Number otherwise) const {
    return has(option) ? static_cast<Number>(std::atof(options_.at(option).front().c_str())) : otherwise;
  }

 private:
  static constexpr std::size_t kAll = 1'000'000;
  std::vector<std::string> words_;
  std::map<std::string, std::vector<std::string>> options_;
};

/// Times of some work, summed over all threads.
struct Times {
  double wall = 0, user = 0, system = 0;  // seconds
  double page_faults = 0;                 // mapped pages: exact even if the kernel only samples system time

  double cpu() const { return user + system; }
  Times& operator+=(const Times& more) {
    wall += more.wall;
    user += more.user;
    system += more.system;
    page_faults += more.page_faults;
    return *this;
  }
};

/// Measures times since construction.
class Stopwatch {
 public:
  Times read() const {
    const Times now = used();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(), now.user - start_.user,
            now.system - start_.system, now.page_faults - start_.page_faults};
  }
  double cpu() const { return read().cpu(); }

 private:
  static double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  static Times used() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {0, seconds(usage.ru_utime), seconds(usage.ru_stime), static_cast<double>(usage.ru_minflt)};
  }
  Times start_ = used();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Times of the run with the least CPU time.
template <class Work>
Times least_of(int runs, const Work& work) {
  Times least;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch watch;
    work();
    const Times times = watch.read();
    if (run == 0 || times.cpu() < least.cpu()) least = times;
  }
  return least;
}

/// Times as members of a JSON object: "seconds": …
inline std::string json_of(const Times& times) {
  char text[200];
  std::snprintf(text, sizeof text,
                "\"seconds\": %.6f, \"cpu_seconds\": %.6f, \"user_seconds\": %.6f, \"system_seconds\": %.6f, "
                "\"page_faults\": %.1f",
                times.wall, times.cpu(), times.user, times.system, times.page_faults);
  return text;
}

/// Prints the only output line of a timed program, in JSON. `more`: further members, each preceded by a comma.
inline void print_result(const std::string& version, const Times& times, std::size_t vertices, std::size_t triangles,
                         const std::string& more = "") {
  std::printf("{\"version\": \"%s\", %s, \"vertices\": %zu, \"triangles\": %zu%s}\n", version.c_str(),
              json_of(times).c_str(), vertices, triangles, more.c_str());
}

/// The raster's path: in the project's data/, else in $SCARP_SHARED/data, or in ../shared/data next to the project.
inline std::optional<std::string> find_raster(const std::filesystem::path& project, const std::string& name) {
  const char* variable = std::getenv("SCARP_SHARED");
  const std::filesystem::path shared = variable != nullptr ? std::filesystem::path(variable) : project / "../shared";
  for (const auto& path : {project / "data" / name, shared / "data" / name}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path.string();
  }
  return std::nullopt;
}

/// The lines of a list, such as bench/quality/rasters.txt, without comments.
inline std::vector<std::string> read_names(const std::filesystem::path& list) {
  std::vector<std::string> names;
  std::ifstream file(list);
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') names.push_back(line);
  }
  return names;
}

inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) die("cannot write " + path.string(), 4);
}

/// Replaces the rows of the table at `path` with the first cell `key` by the rows of `fresh`, which begins with the
/// header. Rows are in the order of `keys`; rows without a key in it are dropped. A table with another header counts as
/// empty.
inline void keep_rows(const std::filesystem::path& path, const std::string& fresh, const std::string& key,
                      const std::vector<std::string>& keys) {
  std::ifstream file(path);
  std::string header, line;
  std::getline(file, header);
  const std::string fresh_header = fresh.substr(0, fresh.find('\n'));
  std::map<std::string, std::string> rows;
  while (header == fresh_header && std::getline(file, line)) rows[line.substr(0, line.find(','))] += line + "\n";
  rows[key] = fresh.substr(fresh_header.size() + 1);
  std::string table = fresh_header + "\n";
  for (const std::string& each : keys) table += rows[each];
  write_file(path, table);
}

}  // namespace bench
