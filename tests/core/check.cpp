// The core without files: simplifies a generated field and prints a hash of each mesh, the same on every machine, for
// WebAssembly and native code.
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "grid/generate.h"
#include "scarp/simplify.h"

namespace {

std::uint64_t hash_of(const scarp::Mesh& mesh) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * std::uint64_t{1099511628211u};
  };
  add(mesh.positions.data(), mesh.positions.size() * sizeof mesh.positions[0]);
  add(mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
  return hash;
}

}  // namespace

int main() {
  const auto field = scarp::generate_field(scarp::FieldStyle::kFractal, 200, 150, 7);
  if (!field) {
    std::printf("%s\n", field.error().message.c_str());
    return 1;
  }
  for (const auto& [name, effort] : {std::pair<std::string_view, scarp::Effort>{"fast", scarp::Effort::kFast},
                                     {"normal", scarp::Effort::kNormal},
                                     {"high", scarp::Effort::kHigh}}) {
    scarp::SimplifyOptions options;
    options.goals.max_error = 20;
    options.quality.effort = effort;
    const auto made = scarp::simplify(field->view(), options);
    if (!made) {
      std::printf("%s\n", made.error().message.c_str());
      return 1;
    }
    if (made->measurement.max_error > 20) return 1;
    std::printf("%s %zu %016llx\n", name.data(), made->mesh.triangle_count(),
                static_cast<unsigned long long>(hash_of(made->mesh)));
  }
  return 0;
}
