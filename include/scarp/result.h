// Handle failures: a call that can fail returns a Result, which holds a value or an Error of one sentence. Check the
// Result with `if (!result)`, or forward the error with the macros below.
//
// Example:
//     const auto half = [](int n) -> scarp::Result<int> {
//       if (n % 2 != 0) return scarp::fail(scarp::ErrorKind::kInput, "3 is odd: give an even number");
//       return n / 2;
//     };
//     SCARP_TRY(const int four, half(8));
//     if (const auto failed = half(3); !failed) std::printf("%d; %s\n", four, failed.error().message.c_str());
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#pragma GCC visibility push(default)

namespace scarp {

/// Kinds of failure that callers can act on. The command line maps each kind to an exit code.
enum class ErrorKind {
  kUsage,      ///< options that conflict or are out of range (exit 1)
  kMemory,     ///< Run::memory is too small for the mesh (exit 1)
  kInput,      ///< a raster or mesh that cannot be read or used (exit 2)
  kPromise,    ///< the requested error bound cannot be met (exit 3)
  kOutput,     ///< a file that cannot be written (exit 4)
  kCancelled,  ///< cancelled by the progress callback or a signal (exit 5)
  kInternal,   ///< a broken invariant: a bug in Scarp (exit 70)
};

/// An error as one sentence, which names its cause (file, pixel, option) and the remedy.
struct Error {
  ErrorKind kind = ErrorKind::kInternal;
  std::string message;
};

/// A value or an Error. The library never prints, aborts, or throws because of bad data. If memory runs out, functions
/// that return a Result return an Error; others (drawing, filling, a Refiner's steps) throw std::bad_alloc.
template <class T>
using Result = tl::expected<T, Error>;

/// Makes an Error: `return fail(ErrorKind::kInput, "…")` in any function that returns a Result.
inline tl::unexpected<Error> fail(ErrorKind kind, std::string message) {
  return tl::unexpected<Error>(Error{kind, std::move(message)});
}

/// The return value of the macros below: an Error that converts to a Result of any type. The conversion is not inlined,
/// since the macros are used a thousand times.
template <class E>
struct ForwardedError {
  E&& error;

  template <class T>
  [[gnu::noinline]] operator tl::expected<T, Error>() && {
    return tl::unexpected<Error>(std::forward<E>(error));
  }
};

template <class E>
ForwardedError<E> forward_error(E&& error) {
  return {std::forward<E>(error)};
}

}  // namespace scarp

/// `SCARP_TRY(const auto& mesh, read_mesh(path));` names the value of a Result, or returns its Error from the enclosing
/// function or lambda, which must return a Result of any type. The Result lives until the end of the block; declare
/// `auto&& mesh` to change or move the value. The value is moved to a target without `&`, as in `SCARP_TRY(job.mesh,
/// read_mesh(path));`, or copied if the expression names a Result. The macro expands to several statements, so it needs
/// braces in a branch.
#define SCARP_TRY(target, ...) SCARP_TRY_AS(SCARP_TRY_NAME(__COUNTER__), target, __VA_ARGS__)

/// `SCARP_RETURN_IF_ERROR(write_mesh(path, mesh));` returns the Error of a Result whose value is not needed.
#define SCARP_RETURN_IF_ERROR(...)                                 \
  do {                                                             \
    SCARP_FORWARD_ERROR(SCARP_TRY_NAME(__COUNTER__), __VA_ARGS__); \
  } while (false)

#define SCARP_TRY_NAME(number) SCARP_TRY_JOIN(scarp_result_, number)
#define SCARP_TRY_JOIN(name, number) name##number
#define SCARP_TRY_AS(result, target, ...)   \
  SCARP_FORWARD_ERROR(result, __VA_ARGS__); \
  target = *std::forward<decltype(result)>(result)
#define SCARP_FORWARD_ERROR(result, ...) \
  auto&& result = (__VA_ARGS__);         \
  if (!result) return scarp::forward_error(std::forward<decltype(result)>(result).error())

#pragma GCC visibility pop
