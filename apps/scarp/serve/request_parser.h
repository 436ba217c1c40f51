// Requests as RFC 9112 defines them. Bytes that two programs could read in two ways are refused, never repaired.
#pragma once

#include <cstddef>
#include <string_view>

#include "serve/http_message.h"

namespace scarp::cli {

struct Refusal {
  int status = 0;
  std::string_view sentence;
};

struct ParsedRequest {
  enum class State {
    kIncomplete,  ///< more bytes are needed
    kWhole,       ///< `request` and `length` are set
    kRefused,     ///< `refusal` is set; the connection must be closed, for the next request's start is not known
  };
  State state = State::kIncomplete;
  Request request;
  std::size_t length = 0;  ///< bytes of the request, with its body, which is read and discarded
  Refusal refusal;
};

/// The longest request line with its headers, and the longest body with its framing.
inline constexpr std::size_t kLongestHead = 8192, kLongestBody = 8192;

/// The first request of a connection's bytes. LAW: more bytes never change a result that is not kIncomplete.
ParsedRequest parse_request(std::string_view bytes);

}  // namespace scarp::cli
