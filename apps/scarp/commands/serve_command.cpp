#include "commands/serve_command.h"

#include <fmt/format.h>

#include "options/option_table.h"
#include "serve/http_server.h"
#include "serve/tile_answers.h"
#include "terminal/signals.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

constexpr const char* kPort = "8080";
constexpr const char* kHost = "127.0.0.1";
constexpr std::uint64_t kMostPort = 65535;

std::string describe(const std::string& input, const TileSetReader& set, const std::string& url) {
  std::uint64_t tiles = 0;
  for (const auto& level : set.tiles()) tiles += level.size();
  std::string text =
      fmt::format("{}: {}, levels 0 to {}\n", input, format_plural(tiles, "tile"), set.tiles().size() - 1);
  text += fmt::format("  at        {}\n", url);
  text += set.format() == TileFormat::kGlb
              ? fmt::format("  CesiumJS  await Cesium.Cesium3DTileset.fromUrl(\"{}tileset.json\")\n", url)
              : fmt::format(
                    "  CesiumJS  await Cesium.CesiumTerrainProvider.fromUrl(\"{}\", {{requestVertexNormals: true}})\n",
                    url);
  return text + "  until     Ctrl-C\n";
}

}  // namespace

ServeCommand::ServeCommand(CLI::App& program) : command_(add_command(program, kServe)) {
  add_option(*command_, OptionId::kInput, input_);
  add_option(*command_, OptionId::kPort, port_);
  add_option(*command_, OptionId::kHost, host_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
}

Result<void> ServeCommand::run() const {
  const Result<std::uint64_t> port = parse_count("--port", port_.value_or(kPort), 0);
  if (!port) return tl::unexpected(port.error());
  if (*port > kMostPort) return fail(ErrorKind::kUsage, fmt::format("--port {} must be at most {}", *port, kMostPort));
  const auto answers = TileAnswers::open(input_);
  if (!answers) return tl::unexpected(answers.error());
  auto server = HttpServer::listen(host_.value_or(kHost), static_cast<int>(*port));
  if (!server) return tl::unexpected(server.error());
  if (!quiet_) {
    if (auto printed = print_summary(describe(input_, answers->set(), server->url())); !printed) return printed;
  }
  return server->run([&](const Request& request) { return answers->answer(request); }, interrupted);
}

}  // namespace scarp::cli
