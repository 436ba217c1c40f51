// The part of streamed samples that a pass over the whole mesh holds at a time.
#pragma once

#include <cstdint>

#include "base/memory_budget.h"
#include "fit/fit.h"
#include "metric/source_bounds.h"
#include "scarp/height_field.h"

namespace scarp {

/// Rows for refine_shapes(), a quarter of the memory at most with their bounds (null: none), if that holds some.
std::int32_t rows_at_once(const HeightField& field, const MemoryBudget& memory, const SourceBounds* bounds = nullptr);
std::uint64_t bytes_at_once(const HeightField& field, const MemoryBudget& memory, const SourceBounds* bounds = nullptr);

/// Makes fit() read windows, of a quarter of the memory at most for a thread, and cuts patches that they mostly hold.
/// They depend on the memory alone, so that the mesh does not on threads. `bounds`: of samples; null: none of their
/// own. The field and they stay alive.
void read_windows(const HeightField& field, const MemoryBudget& memory, FitOptions& options,
                  const SourceBounds* bounds = nullptr);
std::uint64_t window_bytes(const FitOptions& options);

}  // namespace scarp
