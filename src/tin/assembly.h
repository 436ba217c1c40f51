// Assembles one triangulation from the meshes of tiles.
#pragma once

#include <cstdint>
#include <vector>

#include "tin/tile_mesh.h"
#include "tin/triangulation.h"

namespace scarp::tin {

/// A finished tile without its workbench: 13 bytes less per triangle than Triangulation, and no links out of the tile.
struct TilePiece {
  Point first;  ///< the tile's first sample in the raster
  std::int32_t cols = 0, rows = 0;
  Array<geom::TilePoint> points;  ///< vertices, in the order of first use
  Array<std::uint32_t> corners;   ///< 3 per triangle: indices into points
  Array<TileMesh::Link> links;    ///< 3 per triangle
  Array<std::uint8_t> outside;    ///< 1 per triangle
};

/// Numbers the vertices of tile meshes; reuses its scratch memory (16 to 32 bytes a vertex).
class PieceMaker {
 public:
  TilePiece make(const TileMesh& mesh, Point first, std::int32_t cols, std::int32_t rows);

 private:
  struct Slot {
    geom::TilePoint at;
    std::uint32_t id;  // kNone: free
  };
  void clear(std::size_t vertices);
  Slot& find(geom::TilePoint p);

  Array<Slot> slots_;  // a hash table, open addressing
  unsigned shift_ = 0;
};

/// Joins pieces that are appended strip by strip, each row from left to right. Equal vertices on shared borders become
/// one; edges there become ordinary edges, or constrained ones where the domain ends.
class Assembly {
 public:
  /// 0 tiles per row: for one piece alone.
  explicit Assembly(std::size_t tiles_per_row) : below_(tiles_per_row) {}

  /// REQUIRES: neighbours have the same vertices on their shared border.
  void append(const TilePiece& piece);
  /// Appends a triangulation of the rectangle of cols × rows points from `first` on. Its points are relative to
  /// `first`.
  void append(const Triangulation& tin, Point first, std::int32_t cols, std::int32_t rows);

  /// The vertices of the points that were appended last.
  const std::vector<Vertex>& last_vertices() const { return ids_; }

  std::uint64_t vertex_count() const { return tin_.vertex_count(); }
  std::uint64_t triangle_count() const { return tin_.triangle_count(); }

  /// True if no appended triangle is outside.
  bool is_whole() const { return is_whole_; }

  /// The complete triangulation. `seams`: one half-edge of each edge between tiles that is neither constrained nor
  /// outside.
  Triangulation finish(std::vector<HalfEdge>& seams);

 private:
  /// An edge on a border, identified by the coordinate of its start.
  struct BorderEdge {
    std::int32_t at;
    HalfEdge edge;
  };
  /// The vertices and edges on one side of a tile, by coordinate.
  struct Border {
    std::vector<std::pair<std::int32_t, Vertex>> vertices;
    std::vector<BorderEdge> edges;
    Vertex find(std::int32_t at) const;
    void sort();
  };
  template <class Part>
  void append_part(const Part& part);
  template <class Part>
  void add_vertices(const Part& part);
  template <class Part>
  void add_triangles(const Part& part);
  void sew(const Border& theirs, Border& ours);

  Triangulation tin_;
  std::size_t column_ = 0;  // column of the next piece
  bool is_first_row_ = true, is_whole_ = true;
  Border beside_;                       // right side of the piece to the left
  std::vector<Border> below_;           // lower side of the piece above, by column
  Border left_, top_, right_, bottom_;  // borders of the current piece
  std::vector<Vertex> ids_;             // vertices of the current piece
  std::vector<HalfEdge> seams_;
};

}  // namespace scarp::tin
