// Parses requests by RFC 9112. Ambiguous bytes are refused, never repaired.
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
    kRefused,     ///< `refusal` is set; the connection must be closed, since the next request's start is unknown
  };
  State state = State::kIncomplete;
  Request request;
  std::size_t length = 0;  ///< bytes of the request, with its body, which is discarded
  Refusal refusal;
};

/// Limits of the request line with headers, and of the body with its framing.
inline constexpr std::size_t kLongestHead = 8192, kLongestBody = 8192;

/// Parses the first request in a connection's bytes. LAW: more bytes never change a result other than kIncomplete.
ParsedRequest parse_request(std::string_view bytes);

}  // namespace scarp::cli
