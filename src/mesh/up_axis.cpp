#include <array>

#include "scarp/mesh.h"

namespace scarp {
namespace {

constexpr const char* kUp = "up";

/// (x, y, z) → (x, z, −y); 0 − y rather than −y, so that 0 remains 0.
template <class T>
void turn(T* at) {
  const T y = at[1];
  at[1] = at[2];
  at[2] = T{0} - y;
}

/// (x, y, z) → (x, −z, y).
template <class T>
void turn_back(T* at) {
  const T z = at[2];
  at[2] = at[1];
  at[1] = T{0} - z;
}

template <class Turn>
void turn_all(Mesh& mesh, const Turn& turn_one) {
  turn_one(mesh.origin.data());
  for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) turn_one(&mesh.positions[i]);
  for (std::size_t i = 0; i + 2 < mesh.normals.size(); i += 3) turn_one(&mesh.normals[i]);
}

}  // namespace

void turn_y_up(Mesh& mesh) {
  turn_all(mesh, [](auto* at) { turn(at); });
  mesh.metadata[kUp].assign(1, 'y');
}

void undo_y_up(Mesh& mesh) {
  if (!is_y_up(mesh)) return;
  turn_all(mesh, [](auto* at) { turn_back(at); });
  mesh.metadata[kUp].assign(1, 'z');
}

bool is_y_up(const Mesh& mesh) {
  const auto up = mesh.metadata.find(kUp);
  return up != mesh.metadata.end() && up->second == "y";
}

}  // namespace scarp
