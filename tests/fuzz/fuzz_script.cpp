// Any bytes: steps within the raster, or an error with a message.
#include <cstdlib>

#include "io/raster/script.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto steps = scarp::io::decode_script({data, size}, "fuzz.txt", 100, 70);
  if (!steps) {
    const auto& error = steps.error();
    if (error.kind != scarp::ErrorKind::kInput || error.message.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  for (const auto& samples : {steps->inserted, steps->ignored}) {
    for (const scarp::SampleAt& at : samples) {
      if (at.col < 0 || at.col >= 100 || at.row < 0 || at.row >= 70) std::abort();
    }
  }
  return 0;
}
