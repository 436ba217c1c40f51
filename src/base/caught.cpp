#include "base/caught.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <stdexcept>

namespace scarp {

tl::unexpected<Error> caught(ErrorKind kind, std::string_view doing) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return fail(kind, fmt::format("not enough memory to {}", doing));
  } catch (const std::length_error&) {  // from a container larger than any memory
    return fail(kind, fmt::format("not enough memory to {}", doing));
  } catch (const std::exception& error) {
    return fail(ErrorKind::kInternal, fmt::format("cannot {}: {}", doing, error.what()));
  } catch (...) {
    return fail(ErrorKind::kInternal, fmt::format("cannot {}: an unknown exception", doing));
  }
}

}  // namespace scarp
