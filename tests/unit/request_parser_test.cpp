// Requests by RFC 9112: each kind of refusal by name, and accepted requests.
#include "serve/request_parser.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "serve/http_server.h"
#include "serve/media_types.h"
#include "source_dir.h"

namespace scarp::cli {
namespace {

using State = ParsedRequest::State;

struct Case {
  const char* name;
  std::string bytes;
  int status;  ///< 200: accepted; 0: more bytes are needed
};

std::string get(const std::string& fields, const std::string& behind = "") {
  return "GET /a HTTP/1.1\r\nHost: x\r\n" + fields + "\r\n" + behind;
}
std::string line(const std::string& request_line) { return request_line + "\r\nHost: x\r\n\r\n"; }
std::string host(const std::string& value) { return "GET / HTTP/1.1\r\nHost: " + value + "\r\n\r\n"; }
std::string chunked(const std::string& body) { return get("Transfer-Encoding: chunked\r\n", body); }
const std::string kNul("\0", 1);

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      // Lines.
      {"plain", get(""), 200},
      {"nothing yet", "", 0},
      {"half a head", "GET / HTTP/1.1\r\nHost: x\r\n", 0},
      {"an empty line before", "\r\n" + get(""), 200},
      {"two empty lines before", "\r\n\r\n" + get(""), 400},
      {"LF alone behind the request line", "GET / HTTP/1.1\nHost: x\r\n\r\n", 400},
      {"LF alone behind a header", "GET / HTTP/1.1\r\nHost: x\nX: y\r\n\r\n", 400},
      {"LF alone as the empty line", "GET / HTTP/1.1\r\nHost: x\r\n\n", 400},
      {"CR alone in a header", get("X: a\rContent-Length: 5\r\n"), 400},
      {"CR alone in the request line", line("GET /\r HTTP/1.1"), 400},
      {"CR CR LF", get("X: a\r\r\n"), 400},
      {"folded", get("X: a\r\n b\r\n"), 400},
      {"folded by a tab", get("X: a\r\n\tb\r\n"), 400},
      {"a space before the first header", "GET / HTTP/1.1\r\n Host: x\r\n\r\n", 400},
      // Request lines.
      {"no version", line("GET /"), 400},
      {"two spaces", line("GET  / HTTP/1.1"), 400},
      {"a tab", line("GET\t/ HTTP/1.1"), 400},
      {"a space first", line(" GET / HTTP/1.1"), 400},
      {"a space at the end", line("GET / HTTP/1.1 "), 400},
      {"a space in the target", line("GET /a b HTTP/1.1"), 400},
      {"a method of other characters", line("G(T / HTTP/1.1"), 400},
      {"another method", line("PURGE / HTTP/1.1"), 200},
      {"small letters in the version", line("GET / http/1.1"), 400},
      {"HTTP/1.10", line("GET / HTTP/1.10"), 400},
      {"HTTP/1", line("GET / HTTP/1"), 400},
      {"HTTP/2.0", "PRI * HTTP/2.0\r\n\r\n", 505},
      {"HTTP/0.9", line("GET / HTTP/0.9"), 505},
      {"HTTP/9.9", line("GET / HTTP/9.9"), 505},
      {"HTTP/1.7", line("GET / HTTP/1.7"), 200},
      {"too long a target", line("GET /" + std::string(kLongestHead, 'a') + " HTTP/1.1"), 414},
      // Targets.
      {"absolute", line("GET http://example.org:80/a?b HTTP/1.1"), 200},
      {"absolute without a path", line("GET HTTP://example.org HTTP/1.1"), 200},
      {"absolute without a host", line("GET http:///a HTTP/1.1"), 400},
      {"absolute with a user", line("GET http://me@example.org/ HTTP/1.1"), 400},
      {"another scheme", line("GET ftp://example.org/ HTTP/1.1"), 400},
      {"no slash", line("GET a HTTP/1.1"), 400},
      {"an authority", line("GET example.org:80 HTTP/1.1"), 400},
      {"an authority of CONNECT", line("CONNECT example.org:80 HTTP/1.1"), 200},
      {"a path of CONNECT", line("CONNECT / HTTP/1.1"), 400},
      {"an asterisk", line("GET * HTTP/1.1"), 400},
      {"an asterisk of OPTIONS", line("OPTIONS * HTTP/1.1"), 200},
      {"a fragment", line("GET /a#b HTTP/1.1"), 400},
      {"NUL in the target", line("GET /" + kNul + " HTTP/1.1"), 400},
      {"bytes above 127 in the target", line("GET /\xc3\xa4 HTTP/1.1"), 400},
      {"DEL in the target", line("GET /\x7f HTTP/1.1"), 400},
      {"half a code", line("GET /%4 HTTP/1.1"), 400},
      {"no code", line("GET /%zz HTTP/1.1"), 400},
      {"the code of NUL", line("GET /%00 HTTP/1.1"), 400},
      {"no code in the query", line("GET /?a=%g1 HTTP/1.1"), 400},
      // Headers.
      {"a space before the colon", get("Content-Length : 40\r\n"), 400},
      {"a tab before the colon", get("Transfer-Encoding\t: chunked\r\n"), 400},
      {"an empty name", get(": x\r\n"), 400},
      {"no colon", get("nothing\r\n"), 400},
      {"a name of other characters", get("a(b: x\r\n"), 400},
      {"a name of bytes above 127", get("\xc3\xa4: x\r\n"), 400},
      {"NUL in a name", get("a" + kNul + ": x\r\n"), 400},
      {"NUL in a value", get("X: a" + kNul + "b\r\n"), 400},
      {"a control character in a value", get("X: a\x01\r\n"), 400},
      {"DEL in a value", get("X: a\x7f\r\n"), 400},
      {"a vertical tab around a value",
       get("Transfer-Encoding: \x0b"
           "chunked\r\n"),
       400},
      {"an empty value", get("X:\r\n"), 200},
      {"tabs and bytes above 127 in a value", get("X:\ta\t\xc3\xa4 \r\n"), 200},
      {"too many headers", get([] {
         std::string many;
         for (int k = 0; k < 2000; ++k) many += "X: y\r\n";
         return many;
       }()),
       431},
      // Host.
      {"no Host", "GET / HTTP/1.1\r\n\r\n", 400},
      {"no Host of HTTP/1.0", "GET / HTTP/1.0\r\n\r\n", 200},
      {"two Hosts", get("Host: y\r\n"), 400},
      {"the same Host twice", get("Host: x\r\n"), 400},
      {"two Hosts of HTTP/1.0", "GET / HTTP/1.0\r\nHost: x\r\nHost: y\r\n\r\n", 400},
      {"an empty Host", host(""), 400},
      {"a Host and a port", host("example.org:8080"), 200},
      {"a Host and an empty port", host("example.org:"), 200},
      {"an address of IPv6", host("[::1]:8080"), 200},
      {"a bad address of IPv6", host("[::g]"), 400},
      {"an open bracket", host("[::1"), 400},
      {"something behind the bracket", host("[::1]8080"), 400},
      {"a Host with a space", host("a b"), 400},
      {"a Host with a slash", host("a/b"), 400},
      {"a Host with a user", host("me@a"), 400},
      {"a list of Hosts", host("a,b"), 400},
      {"a port of letters", host("a:b"), 400},
      {"too large a port", host("a:65536"), 400},
      // Lengths and codings.
      {"a body", get("Content-Length: 5\r\n", "hello"), 200},
      {"a part of a body", get("Content-Length: 5\r\n", "hell"), 0},
      {"an empty length", get("Content-Length:\r\n"), 400},
      {"a sign before the length", get("Content-Length: +5\r\n", "hello"), 400},
      {"a negative length", get("Content-Length: -5\r\n"), 400},
      {"a space in the length", get("Content-Length: 1 5\r\n"), 400},
      {"a fraction", get("Content-Length: 5.0\r\n"), 400},
      {"a hexadecimal length", get("Content-Length: 0x5\r\n"), 400},
      {"a length beyond 64 bits", get("Content-Length: 18446744073709551621\r\n"), 400},
      {"too long a body", get("Content-Length: 1000000\r\n"), 413},
      {"two lengths", get("Content-Length: 5\r\nContent-Length: 6\r\n"), 400},
      {"a length twice", get("Content-Length: 5\r\nContent-Length: 5\r\n"), 400},
      {"a list of lengths", get("Content-Length: 5, 5\r\n"), 400},
      {"a length and a coding", get("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n"), 400},
      {"a coding of HTTP/1.0", "GET / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n", 400},
      {"an unknown coding", get("Transfer-Encoding: xchunked\r\n"), 501},
      {"an unknown coding before chunked", get("Transfer-Encoding: foo, chunked\r\n"), 501},
      {"gzip before chunked", get("Transfer-Encoding: gzip, chunked\r\n"), 501},
      {"gzip alone", get("Transfer-Encoding: gzip\r\n"), 400},
      {"identity", get("Transfer-Encoding: identity\r\n"), 400},
      {"chunked before another", get("Transfer-Encoding: chunked, gzip\r\n"), 400},
      {"chunked twice", get("Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n"), 400},
      {"an empty coding", get("Transfer-Encoding:\r\n"), 400},
      {"a coding in quotes", get("Transfer-Encoding: \"chunked\"\r\n"), 400},
      {"chunked in other letters", get("Transfer-Encoding: Chunked\r\n", "0\r\n\r\n"), 200},
      {"an expectation", get("Expect: 100-continue\r\nContent-Length: 5\r\n"), 417},
      // Chunks.
      {"chunks", chunked("5\r\nhello\r\nA\r\n0123456789\r\n0\r\n\r\n"), 200},
      {"chunks with a trailer", chunked("1\r\nx\r\n0\r\nX: y\r\nHost: z\r\n\r\n"), 200},
      {"chunks with extensions", chunked("1;a\r\nx\r\n1 ; a = b\r\nx\r\n1;a=\"b;\\\"\"\r\nx\r\n000\r\n\r\n"), 200},
      {"a part of a chunk", chunked("5\r\nhel"), 0},
      {"no last chunk", chunked("5\r\nhello\r\n"), 0},
      {"a negative size", chunked("-1\r\n"), 400},
      {"a size with a sign", chunked("+5\r\nhello\r\n0\r\n\r\n"), 400},
      {"a size of other letters", chunked("g\r\n"), 400},
      {"a size with 0x", chunked("0x5\r\nhello\r\n0\r\n\r\n"), 400},
      {"no size", chunked("\r\nhello\r\n0\r\n\r\n"), 400},
      {"a space before the size", chunked(" 5\r\nhello\r\n0\r\n\r\n"), 400},
      {"a space behind the size", chunked("5 \r\nhello\r\n0\r\n\r\n"), 400},
      {"a size beyond 64 bits", chunked("10000000000000005\r\nhello\r\n0\r\n\r\n"), 400},
      {"too large a chunk", chunked("ffffff\r\n"), 413},
      {"LF alone behind the size", chunked("5\nhello\r\n0\r\n\r\n"), 400},
      {"LF alone behind an extension", chunked("5;a\nhello\r\n0\r\n\r\n"), 400},
      {"an extension without a name", chunked("5;\r\nhello\r\n0\r\n\r\n"), 400},
      {"an extension without a value", chunked("5;a=\r\nhello\r\n0\r\n\r\n"), 400},
      {"an extension without a semicolon", chunked("5 a\r\nhello\r\n0\r\n\r\n"), 400},
      {"an open quote", chunked("5;a=\"b\r\nhello\r\n0\r\n\r\n"), 400},
      {"CR alone in an extension", chunked("5;a=\"\r\"\r\nhello\r\n0\r\n\r\n"), 400},
      {"more bytes than the size", chunked("5\r\nhelloo\r\n0\r\n\r\n"), 400},
      {"LF alone behind a chunk", chunked("5\r\nhello\n0\r\n\r\n"), 400},
      {"a folded trailer", chunked("0\r\nX: y\r\n z\r\n\r\n"), 400},
      {"a trailer without a colon", chunked("0\r\nxy\r\n\r\n"), 400},
      {"many small chunks", chunked([] {
         std::string many;
         for (int k = 0; k < 2000; ++k) many += "1\r\nx\r\n";
         return many;
       }()),
       413},
  };
  return cases;
}

int status_of(const ParsedRequest& parsed) {
  return parsed.state == State::kIncomplete ? 0 : parsed.state == State::kWhole ? 200 : parsed.refusal.status;
}

TEST(RequestParser, AcceptsAndRefusesByTheRfc) {
  for (const Case& one : all_cases()) {
    const ParsedRequest parsed = parse_request(one.bytes);
    EXPECT_EQ(status_of(parsed), one.status) << one.name << ": " << parsed.refusal.sentence;
    if (one.status == 200) {
      EXPECT_EQ(parsed.length, one.bytes.size()) << one.name;
    }
    EXPECT_EQ(parsed.refusal.sentence.empty(), one.status == 0 || one.status == 200) << one.name;
  }
}

TEST(RequestParser, MoreBytesNeverChangeAResult) {
  for (const Case& one : all_cases()) {
    const std::string bytes = one.bytes + get("");
    const ParsedRequest whole = parse_request(bytes);
    for (std::size_t k = 0; k < std::min<std::size_t>(bytes.size(), 400); ++k) {
      const ParsedRequest part = parse_request(std::string_view(bytes).substr(0, k));
      if (part.state == State::kIncomplete) continue;
      EXPECT_EQ(status_of(part), status_of(whole)) << one.name << ", " << k << " bytes";
      EXPECT_EQ(part.length, whole.length) << one.name << ", " << k << " bytes";
    }
  }
}

TEST(RequestParser, ABodyIsNoSecondRequest) {
  const std::string second = get("Connection: close\r\n");
  const std::string first = get("Content-Length: " + std::to_string(second.size()) + "\r\n", second);
  EXPECT_EQ(parse_request(first + second).length, first.size());
  const std::string in_chunks = chunked("1\r\nx\r\n0\r\n\r\n");
  EXPECT_EQ(parse_request(in_chunks + second).length, in_chunks.size());
}

TEST(RequestParser, ReadsWhatTheAnswerNeeds) {
  const Request request =
      parse_request("HEAD http://example.org/%61%20b?v=%31&w HTTP/1.1\r\nHOST: x\r\nAccept: a\r\naccept: \t b \r\n\r\n")
          .request;
  EXPECT_EQ(request.method, "HEAD");
  EXPECT_EQ(request.path, "/a b");
  EXPECT_EQ(request.query, "v=%31&w");
  EXPECT_EQ(request.header("accept"), "a, b");
  EXPECT_TRUE(request.keeps_alive);
  EXPECT_EQ(parse_request("GET http://example.org?a HTTP/1.1\r\nHost: x\r\n\r\n").request.path, "/");
}

TEST(RequestParser, ConnectionsStayAsTheClientAsks) {
  const auto stays = [](const char* version, const char* option) {
    return parse_request(std::string("GET / ") + version + "\r\nHost: x\r\nConnection: " + option + "\r\n\r\n")
        .request.keeps_alive;
  };
  EXPECT_TRUE(stays("HTTP/1.1", ""));
  EXPECT_FALSE(stays("HTTP/1.1", "Close"));
  EXPECT_FALSE(stays("HTTP/1.1", "keep-alive, close"));
  EXPECT_TRUE(stays("HTTP/1.1", "not-close"));
  EXPECT_FALSE(stays("HTTP/1.0", ""));
  EXPECT_TRUE(stays("HTTP/1.0", "Keep-Alive"));
}

TEST(MediaTypes, ComeFromTheEndingInAnyCase) {
  EXPECT_EQ(media_type_of("Assets/icon.SVG"), "image/svg+xml");
  EXPECT_EQ(media_type_of("a.b.png"), "image/png");
  EXPECT_EQ(media_type_of("draco.wasm"), "application/wasm");
  EXPECT_EQ(media_type_of("0/0/0.terrain"), "application/vnd.quantized-mesh");
  EXPECT_EQ(media_type_of("png"), "application/octet-stream");
  EXPECT_EQ(media_type_of("a.unknown"), "application/octet-stream");
}

TEST(ServeDocs, NameTheNumberOfConnections) {
  std::ifstream file(source_dir() + "/docs/cli/serve.md");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  std::smatch found;
  ASSERT_TRUE(std::regex_search(text, found, std::regex("([0-9]+) connections")));
  EXPECT_EQ(found[1], std::to_string(HttpServer::kMostConnections));
}

}  // namespace
}  // namespace scarp::cli
