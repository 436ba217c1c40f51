// Structs as inputs that readers treat like files.
#pragma once

#include <optional>
#include <string>

#include "io/lend.h"
#include "scarp_c.h"

namespace scarp::door {

/// Lends a field or points, and the arrays of the options, to readers, which find them by name.
class LentInputs {
 public:
  LentInputs(const scarp_field* field, const scarp_options& asked);
  LentInputs(const scarp_points* points, const scarp_options& asked);

  /// kUsage for a required pointer that is null or a number out of range.
  Result<void> check() const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::string unfit_;  ///< reason why the struct cannot be read, or empty
  io::LentRaster raster_, mask_, tolerance_;
  PointSet points_;
  std::optional<io::Lent> lent_, lent_mask_, lent_tolerance_;
};

}  // namespace scarp::door
