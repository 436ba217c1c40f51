// Any bytes: a height field of the declared size, or an error with a message.
#include <cstdlib>

#include "io/raster/pgm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  scarp::ReadOptions options;
  options.run.memory.limit = 64 << 20;
  const auto field = scarp::io::decode_pgm(bytes, "fuzz.pgm", options);
  if (!field && field.error().message.empty()) std::abort();
  if (field && field->samples.size() != static_cast<std::size_t>(field->cols) * static_cast<std::size_t>(field->rows))
    std::abort();
  return 0;
}
