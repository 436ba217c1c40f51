#include "paper/plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>
#include <utility>

#include "scarp/io.h"

extern char** environ;

namespace scarp::paper {
namespace {

namespace fs = std::filesystem;

/// A folder of its own that goes away with it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    path_ = (fs::temp_directory_path(error) / "scarp-paper-XXXXXX").string();
    if (error || mkdtemp(path_.data()) == nullptr) path_.clear();
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  bool exists() const { return !path_.empty(); }
  std::string file(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Runs gnuplot without a shell, its messages going to `log`. Its exit code; −1 if it could not be started.
int run_gnuplot(const std::string& argument, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  std::string name = "gnuplot", word = argument;
  std::array<char*, 3> arguments{name.data(), word.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) == -1) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) != 127 ? WEXITSTATUS(status) : -1;
}

tl::unexpected<Error> missing() {
  return fail(ErrorKind::kOutput,
              "gnuplot, which draws the plots, cannot be run: install the Debian package gnuplot-nox");
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// For gnuplot's double quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

const char* style_words(Curve::Style style) {
  switch (style) {
    case Curve::Style::kLine:
      return "lines lw 2";
    case Curve::Style::kPoints:
      return "points pt 6 ps 1.4 lw 2";
    case Curve::Style::kLineAndPoints:
      return "linespoints lw 2 pt 7 ps 0.7";
    case Curve::Style::kDashes:
      return "lines lw 1.5 dt 2";
  }
  return "lines";
}

std::string make_data(const Plot& plot) {
  std::string data;
  for (const Curve& curve : plot.curves) {
    for (const auto& [x, y] : curve.points) data += fmt::format("{:.9g} {:.9g}\n", x, y);
    data += "\n\n";
  }
  return data;
}

std::string make_script(const Plot& plot, const std::string& data, const std::string& png) {
  std::string script =
      "set terminal pngcairo size 900,540\nset encoding utf8\nset grid lc rgb '#dddddd'\nset border 3\nset tics "
      "nomirror\n"
      "set linetype 1 lc rgb '#1f5fa8'\nset linetype 2 lc rgb '#d1611f'\nset linetype 3 lc rgb '#2d8a4e'\n"
      "set linetype 4 lc rgb '#a2318f'\nset linetype 5 lc rgb '#7a6a2a'\nset linetype 6 lc rgb '#555555'\n"
      "set linetype 7 lc rgb '#c02b3c'\nset linetype 8 lc rgb '#1798a3'\n";
  script += fmt::format("set output {}\nset title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                        quoted(png), quoted(plot.title), quoted(plot.x_label), quoted(plot.y_label));
  script += fmt::format("set key {} noenhanced\n", plot.key_place);
  if (plot.log_x) script += "set logscale x\nset format x '10^{%L}'\n";
  if (plot.log_y) script += "set logscale y\nset format y '10^{%L}'\n";
  script += "plot ";
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const Curve& curve = plot.curves[k];
    script += fmt::format("{}{} index {} using 1:2 with {} lt {} {}", k == 0 ? "" : ", \\\n     ", quoted(data), k,
                          style_words(curve.style), curve.color,
                          curve.title.empty() ? "notitle" : "title " + quoted(curve.title));
  }
  return script + "\nset output\n";
}

}  // namespace

Result<void> find_gnuplot() {
  if (run_gnuplot("--version", "/dev/null") != 0) return missing();
  return {};
}

Result<std::vector<std::uint8_t>> draw_plot(const Plot& plot) {
  const ScratchFolder folder;
  if (!folder.exists()) {
    return fail(ErrorKind::kOutput,
                "no temporary folder can be made for gnuplot: set TMPDIR to one that can be written");
  }
  const std::string data = folder.file("data"), script = folder.file("script"), png = folder.file("plot.png"),
                    log = folder.file("log");
  SCARP_RETURN_IF_ERROR(write_file(data, bytes_of(make_data(plot))));
  SCARP_RETURN_IF_ERROR(write_file(script, bytes_of(make_script(plot, data, png))));
  const int code = run_gnuplot(script, log);
  if (code == -1) return missing();
  if (code != 0) {
    const auto words = read_file(log);
    return fail(ErrorKind::kOutput, fmt::format("gnuplot refuses the plot {}: {}", plot.title,
                                                words ? std::string(words->begin(), words->end()) : ""));
  }
  return read_file(png);
}

}  // namespace scarp::paper
