// Errors as values.
#pragma once

#include <string>
#include <tl/expected.hpp>

#pragma GCC visibility push(default)

namespace scarp {

/// Kinds of failure, in the terms a caller can act on. The command line maps each kind to an exit code.
enum class ErrorKind {
  kUsage,      ///< options that cannot be combined or lie outside their range (exit 1)
  kMemory,     ///< Run::memory is too little for the mesh (exit 1)
  kInput,      ///< a raster or mesh that cannot be read or holds nothing usable (exit 2)
  kPromise,    ///< the error bound asked for cannot be met (exit 3)
  kOutput,     ///< a file that cannot be written (exit 4)
  kCancelled,  ///< the progress callback or a signal asked to stop (exit 5)
  kInternal,   ///< a broken invariant: a bug in Scarp (exit 70)
};

/// One sentence that names the culprit (file, pixel, option) and the way out.
struct Error {
  ErrorKind kind = ErrorKind::kInternal;
  std::string message;
};

/// A value or an Error. Nothing in the library throws for bad data, prints, or aborts. Where memory runs out, a
/// function that returns a Result returns an Error; one that does not (drawing, filling, a Refiner's steps) throws
/// std::bad_alloc.
template <class T>
using Result = tl::expected<T, Error>;

/// `return fail(ErrorKind::kInput, "…")` from any function that returns a Result.
inline tl::unexpected<Error> fail(ErrorKind kind, std::string message) {
  return tl::unexpected<Error>(Error{kind, std::move(message)});
}

}  // namespace scarp

#pragma GCC visibility pop
