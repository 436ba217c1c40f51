// Prepares the lines of a run: before the run, or in parallel with the refinement of tiles if that needs no lines.
#pragma once

#include "lines/field_lines.h"
#include "pieces/recipe.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::run {

class LineWork {
 public:
  /// Uses lines and cutline of the recipe, which must stay alive; `tolerance` as for prepare_lines().
  LineWork(const pieces::Recipe& recipe, double tolerance) : recipe_(recipe), tolerance_(tolerance) {}

  /// True if the refinement of tiles need not wait for the lines: they change no sample and cut nothing, all are within
  /// reach of the lattice, and there is a second thread.
  bool may_wait() const;
  /// Calls prepare_lines() the first time only, and fails like it.
  Result<void> prepare();
  bool is_prepared() const { return is_prepared_; }

  /// REQUIRES: is_prepared(), or may_wait() of the field.
  HeightField field() const { return lines_.apply(recipe_.field); }
  /// REQUIRES: is_prepared().
  const lines::ConstraintGraph& graph() const { return lines_.graph; }
  lines::FieldLines& lines() { return lines_; }
  double seconds() const { return seconds_; }

 private:
  const pieces::Recipe& recipe_;
  double tolerance_;
  lines::FieldLines lines_;
  double seconds_ = 0;
  bool is_prepared_ = false;
};

}  // namespace scarp::run
