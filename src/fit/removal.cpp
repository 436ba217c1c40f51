#include "fit/removal.h"

#include <limits>

#include "fit/removal_queue.h"

namespace scarp::fit {

namespace {

using Id = Patch::Id;

class Removal {
 public:
  Removal(Patch& patch, const TriangleError& error, std::size_t most, const std::function<bool()>& is_time_up,
          const std::vector<std::uint8_t>& settled)
      : patch_(patch),
        error_(error),
        most_(most),
        is_time_up_(is_time_up),
        settled_(settled),
        left_(patch.count_faces()) {}

  bool wants(Id v) const { return settled_[v] == 0; }
  bool is_over() const { return left_ <= most_ || (is_time_up_ && is_time_up_()); }
  float energy_of(Id f) {
    const Patch::Face& face = patch_.face(f);
    if (face.energy < 0) {
      const auto verdict = error_.assess(patch_.at(face.corners[0]), patch_.at(face.corners[1]),
                                         patch_.at(face.corners[2]), std::numeric_limits<float>::infinity());
      patch_.set_measure(f, verdict.worst, verdict.energy);
    }
    return face.energy;
  }
  std::span<const Id> remove(Id v, const Patch::Star& star, std::span<const Patch::RingTriangle> triangles) {
    patch_.remove(v, star, triangles);
    ++removed_;
    left_ -= star.faces.size() - triangles.size();
    return star.ring;
  }

  std::uint64_t removed() const { return removed_; }

 private:
  Patch& patch_;
  const TriangleError& error_;
  const std::size_t most_;  // triangles
  const std::function<bool()>& is_time_up_;
  const std::vector<std::uint8_t>& settled_;
  std::size_t left_;
  std::uint64_t removed_ = 0;
};

}  // namespace

RemovalCounts remove_vertices(Patch& patch, const TriangleError& error, const ShapeRule& shape, std::size_t most,
                              const std::function<bool()>& is_time_up, std::vector<std::uint8_t>& settled) {
  RemovalQueue queue(patch, error, shape);
  Removal removal(patch, error, most, is_time_up, settled);
  queue.run(removal);
  if (removal.is_over()) return {removal.removed(), queue.searches()};
  for (Id v = 0; v < patch.node_count(); ++v) {
    if (!patch.is_locked(v)) settled[v] = 1;
  }
  return {removal.removed(), queue.searches()};
}

}  // namespace scarp::fit
