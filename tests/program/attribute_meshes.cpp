// Writes a small terrain with colours, uvs and channels in every format, for foreign programs: attribute_meshes FOLDER
#include <cstdio>
#include <limits>

#include "scarp/io.h"
#include "unit/mesh_samples.h"

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  scarp::Mesh colored = scarp::test::grid_mesh(
      20, 30, [](int, int) { return true; }, true);
  scarp::test::add_attributes(colored, 4);
  scarp::Mesh photo = colored;  // channels contained in its colours
  photo.channel_count = 3;
  photo.channels.assign(photo.colors.begin(), photo.colors.end());
  photo.uvs.clear();
  scarp::Mesh bare = colored;  // only channels, with one missing value
  bare.colors.clear();
  bare.channels[7] = std::numeric_limits<float>::quiet_NaN();
  for (const char* extension : {"glb", "obj", "ply", "stl", "tin", "vtu", "vtp"}) {
    for (const auto& [mesh, name] : {std::pair{&colored, "colored"}, {&photo, "photo"}, {&bare, "bare"}}) {
      const auto written = scarp::write_mesh(*mesh, std::string(argv[1]) + "/" + name + "." + extension);
      if (written) continue;
      std::fprintf(stderr, "%s\n", written.error().message.c_str());
      return 1;
    }
  }
  std::printf("%zu %zu\n", colored.vertex_count(), colored.triangle_count());
}
