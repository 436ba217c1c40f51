#include "refine/dominant.h"

#include <algorithm>
#include <utility>

namespace scarp::refine {

namespace {

using Id = tin::TileMesh::Id;

class Walk {
 public:
  Walk(tin::TileMesh& mesh, TileScanner& scanner, std::vector<geom::TilePoint>* inserted)
      : mesh_(mesh), scanner_(scanner), inserted_(inserted) {
    std::vector<Id> all(mesh.triangle_count());
    for (Id t = 0; t < all.size(); ++t) all[t] = t;
    scanner.scan(mesh, all, {});
    for (const Id t : all) push(t);
  }

  DominantRun run(std::size_t most) {
    while (!stack_.empty()) {
      const auto [key, t] = stack_.back();
      if (mesh_[t].key != key) {
        stack_.pop_back();  // changed since it was pushed
        continue;
      }
      const geom::TilePoint p = candidate_of(key);
      Entry worst{key, t};
      for (const tin::TileMesh::Link link : mesh_[t].links) consider(link, worst);
      if (worst.triangle == t) {
        const tin::TileMesh::Cavity cavity = mesh_.find_cavity(t, p);
        for (const Id removed : cavity.removed) consider_triangle(removed, worst);
        for (const auto& side : cavity.sides) consider(side.beyond, worst);
        if (worst.triangle == t) {
          if (mesh_.vertex_count() >= most) {
            done_.finished = false;
            return done_;
          }
          stack_.pop_back();
          insert(p, cavity);
          continue;
        }
      }
      stack_.push_back(worst);
      ++done_.moves;
    }
    return done_;
  }

 private:
  struct Entry {
    std::int64_t key;
    Id triangle;
  };

  void push(Id t) {
    if (const std::int64_t key = mesh_[t].key; key > 0) {
      stack_.push_back({key, t});
      ++done_.moves;
    }
  }
  void consider_triangle(Id t, Entry& worst) const {
    if (const std::int64_t key = mesh_[t].key; key > worst.key) worst = {key, t};
  }
  void consider(tin::TileMesh::Link link, Entry& worst) const {
    if (link != tin::TileMesh::kBorder) consider_triangle(tin::TileMesh::triangle_of(link), worst);
  }

  void insert(geom::TilePoint p, const tin::TileMesh::Cavity& cavity) {
    hints_.clear();
    for (const Id t : cavity.removed) {
      const std::int64_t key = mesh_[t].key;
      if (key > 0 && candidate_of(key) != p) hints_.push_back(candidate_of(key));
    }
    const auto fresh = mesh_.fill_cavity(p);
    scanner_.scan(mesh_, fresh, hints_);
    const std::size_t first = stack_.size();
    for (const Id t : fresh) push(t);
    if (stack_.size() > first + 1) {
      const auto worst = std::max_element(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end(),
                                          [](const Entry& a, const Entry& b) { return a.key < b.key; });
      std::swap(*worst, stack_.back());
    }
    ++done_.insertions;
    if (inserted_ != nullptr) inserted_->push_back(p);
  }

  tin::TileMesh& mesh_;
  TileScanner& scanner_;
  std::vector<geom::TilePoint>* inserted_;
  std::vector<Entry> stack_;
  std::vector<geom::TilePoint> hints_;
  DominantRun done_;
};

}  // namespace

DominantRun refine_dominant(tin::TileMesh& mesh, TileScanner& scanner, std::size_t most,
                            std::vector<geom::TilePoint>* inserted) {
  return Walk(mesh, scanner, inserted).run(most);
}

}  // namespace scarp::refine
