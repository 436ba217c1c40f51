// When the lines of a run are made ready: before it, or in parallel to the refinement of tiles if that needs none of
// them.
#pragma once

#include "lines/field_lines.h"
#include "pieces/recipe.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

class LineWork {
 public:
  /// Lines and cutline of the recipe, which stays alive; `tolerance` as for prepare_lines().
  LineWork(const Recipe& recipe, double tolerance) : recipe_(recipe), tolerance_(tolerance) {}

  /// Lines change no sample and cut nothing, all are in reach of the lattice, and there is a second thread: whoever
  /// refines tiles need not wait for them.
  bool may_wait() const;
  /// prepare_lines(), the first time only; fails as that does.
  Result<void> prepare();
  bool is_prepared() const { return is_prepared_; }

  /// REQUIRES: is_prepared(), or may_wait() of the field.
  HeightField field() const { return lines_.apply(recipe_.field); }
  /// REQUIRES: is_prepared().
  const ConstraintGraph& graph() const { return lines_.graph; }
  FieldLines& lines() { return lines_; }
  double seconds() const { return seconds_; }

 private:
  const Recipe& recipe_;
  double tolerance_;
  FieldLines lines_;
  double seconds_ = 0;
  bool is_prepared_ = false;
};

}  // namespace scarp
