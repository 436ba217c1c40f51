// Any bytes as HTTP requests, cut anywhere: more bytes never change a result, and refusals have a message. The first
// byte chooses where the bytes are cut.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "serve/request_parser.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using scarp::cli::ParsedRequest;
  if (size == 0) return 0;
  std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  const std::size_t cut = bytes.size() * data[0] / 256;
  while (!bytes.empty()) {
    const ParsedRequest whole = scarp::cli::parse_request(bytes);
    const ParsedRequest part = scarp::cli::parse_request(bytes.substr(0, cut));
    if (part.state != ParsedRequest::State::kIncomplete && (part.state != whole.state || part.length != whole.length ||
                                                            part.refusal.sentence != whole.refusal.sentence))
      std::abort();
    if (whole.state == ParsedRequest::State::kRefused && (whole.refusal.status < 400 || whole.refusal.sentence.empty()))
      std::abort();
    if (whole.state != ParsedRequest::State::kWhole) return 0;
    if (whole.length == 0 || whole.length > bytes.size()) std::abort();
    bytes.remove_prefix(whole.length);
  }
  return 0;
}
