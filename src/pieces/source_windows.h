// The window of streamed samples that a pass over the whole mesh holds at a time.
#pragma once

#include <cstdint>

#include "base/memory_budget.h"
#include "fit/fit.h"
#include "metric/source_bounds.h"
#include "scarp/height_field.h"

namespace scarp::pieces {

/// Number of rows that refine_shapes() holds at a time. With their bounds (null: none) they need at most a quarter of
/// the memory, but there are at least a few rows.
std::int32_t rows_at_once(const HeightField& field, const MemoryBudget& memory,
                          const metric::SourceBounds* bounds = nullptr);
std::uint64_t bytes_at_once(const HeightField& field, const MemoryBudget& memory,
                            const metric::SourceBounds* bounds = nullptr);

/// Makes fit() read windows of at most a quarter of the memory per thread, and cut patches that mostly fit these
/// windows. Windows depend only on the memory, so the mesh does not depend on threads. `bounds`: of samples, may be
/// null. Borrows field and bounds.
void read_windows(const HeightField& field, const MemoryBudget& memory, fit::FitOptions& options,
                  const metric::SourceBounds* bounds = nullptr);
std::uint64_t window_bytes(const fit::FitOptions& options);

}  // namespace scarp::pieces
