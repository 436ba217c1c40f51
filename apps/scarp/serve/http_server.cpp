#include "serve/http_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "serve/answer_queue.h"
#include "serve/request_parser.h"
#include "session/text/clock.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr std::size_t kLeastConnections = 16, kChunk = 1 << 16;
/// An address may use 1 / kShareOfAddress of the connections.
constexpr std::size_t kShareOfAddress = 2;
/// Maximum number of chunks sent to one client, and of clients accepted, before other work continues.
constexpr int kMostChunksAtOnce = 16, kMostAcceptedAtOnce = 64;
/// Bytes of an answer that the system queues; progress is visible after each such amount.
constexpr int kMostUnsent = 1 << 16;
/// More bytes than fit in the buffers of a client that never reads.
constexpr std::uint64_t kSurelyTaken = 1 << 18;
constexpr std::size_t kMostWaitingBytes = 64'000'000;
constexpr std::chrono::seconds kToAsk{10}, kToTake{30}, kToClose{2}, kCredit{5};
constexpr std::uint64_t kLeastPerSecond = 10000;  // bytes
constexpr int kPollMilliseconds = 400;

bool would_wait(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

/// Half of the files that the process may open. Raises the process's own limit if allowed.
std::size_t find_places() {
  constexpr std::size_t kMost = HttpServer::kMostConnections;
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return kLeastConnections;
  if (files.rlim_cur < 2 * kMost) {
    const rlimit more{std::min<rlim_t>(files.rlim_max, 2 * kMost), files.rlim_max};
    if (::setrlimit(RLIMIT_NOFILE, &more) == 0) files = more;
  }
  return std::clamp<std::size_t>(files.rlim_cur / 2, kLeastConnections, kMost);
}

/// The client to which a connection belongs: an IPv4 address, or the 64-bit IPv6 network of a household.
std::string client_of(const sockaddr_storage& address) {
  const void* const bytes = &address;
  if (address.ss_family == AF_INET) {
    const in_addr& one = static_cast<const sockaddr_in*>(bytes)->sin_addr;
    return {reinterpret_cast<const char*>(&one), sizeof one};
  }
  const in6_addr& one = static_cast<const sockaddr_in6*>(bytes)->sin6_addr;
  const bool holds_ipv4 = IN6_IS_ADDR_V4MAPPED(&one);
  return std::string(reinterpret_cast<const char*>(one.s6_addr) + (holds_ipv4 ? 12 : 0), holds_ipv4 ? 4 : 8);
}

/// A client's connection, which repeats a request, a wait and an answer.
class Connection {
 public:
  Connection(int fd, std::uint64_t number, std::string client, AnswerQueue& queue)
      : fd_(fd),
        number_(number),
        client_(std::move(client)),
        queue_(queue),
        moved_(Clock::now()),
        deadline_(moved_ + kToAsk) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (waits_) queue_.forget(number_);
    ::close(fd_);
  }

  int fd() const { return fd_; }
  std::uint64_t number() const { return number_; }
  const std::string& client() const { return client_; }
  short events() const { return waits_ ? 0 : is_answering() ? POLLOUT : POLLIN; }
  bool is_late(Clock::time_point now) const { return !waits_ && now > deadline_; }
  /// True while the server works on the request, when missing progress is not the client's fault.
  bool waits() const { return waits_; }
  /// Time of the last byte in either direction. A client that has received more than buffers hold gets some extra
  /// seconds, since its system may accept more bytes only when half of its buffer is free. Otherwise new connections
  /// would end a slow download.
  Clock::time_point last_progress() const {
    return is_answering() && taken_ > kSurelyTaken ? moved_ + kCredit : moved_;
  }
  /// Bytes in memory for this client.
  std::size_t waiting_bytes() const { return waiting_.size(); }

  /// All return false if the connection must be closed.
  bool receive() {
    std::array<char, 4096> bytes;
    const ssize_t got = ::recv(fd_, bytes.data(), bytes.size(), 0);
    if (got < 0) return would_wait(errno);
    if (got == 0) return false;
    if (lingers_) return true;
    moved_ = Clock::now();
    asked_.append(bytes.data(), static_cast<std::size_t>(got));
    ask_next();
    return true;
  }
  void take(AnswerQueue::Done done) {
    waits_ = false;
    begin(done.request, std::move(done.response));
  }
  bool send() {
    for (int chunks = 0; is_answering(); ++chunks) {
      if (chunks == kMostChunksAtOnce) return true;
      if (sent_ == waiting_.size() && !refill()) return false;
      const ssize_t sent = ::send(fd_, waiting_.data() + sent_, waiting_.size() - sent_, MSG_NOSIGNAL);
      if (sent < 0) return would_wait(errno);
      sent_ += static_cast<std::size_t>(sent);
      taken_ += static_cast<std::uint64_t>(sent);
      moved_ = Clock::now();
    }
    waiting_ = {};
    sent_ = 0;
    file_ = {};
    if (closes_) {
      // Closing with unread bytes could lose the answer in transit, so the client closes first.
      lingers_ = true;
      deadline_ = moved_ + kToClose;
      return ::shutdown(fd_, SHUT_WR) == 0;
    }
    deadline_ = moved_ + kToAsk;
    ask_next();
    return true;
  }

 private:
  bool is_answering() const { return sent_ < waiting_.size() || file_.length > 0; }

  void ask_next() {
    ParsedRequest parsed = parse_request(asked_);
    if (parsed.state == ParsedRequest::State::kIncomplete) return;
    if (parsed.state == ParsedRequest::State::kRefused) {
      begin({}, text_response(parsed.refusal.status, std::string(parsed.refusal.sentence)));
      return;
    }
    asked_.erase(0, parsed.length);
    waits_ = true;
    queue_.ask(number_, std::move(parsed.request));
  }

  /// Begins an answer. Without a request, the connection ends after the answer.
  void begin(const std::optional<Request>& request, Response response) {
    closes_ = !request || !request->keeps_alive;
    const std::string head = write_head(response, !closes_);
    waiting_.assign(head.begin(), head.end());
    sent_ = 0;
    file_ = {};
    const std::uint64_t length = response.length();
    moved_ = Clock::now();
    taken_ = 0;
    deadline_ = moved_ + kToTake + std::chrono::seconds(length / kLeastPerSecond);
    if (request && request->method == "HEAD") return;
    waiting_.insert(waiting_.end(), response.body.begin(), response.body.end());
    file_ = std::move(response.file);
  }

  /// Reads the next bytes of the file; false if it has become shorter.
  bool refill() {
    waiting_.resize(std::min<std::uint64_t>(kChunk, file_.length));
    sent_ = 0;
    const ssize_t got = ::pread(file_.file->fd(), waiting_.data(), waiting_.size(), static_cast<off_t>(file_.offset));
    if (got <= 0) return false;
    waiting_.resize(static_cast<std::size_t>(got));
    file_.offset += static_cast<std::uint64_t>(got);
    file_.length -= static_cast<std::uint64_t>(got);
    return true;
  }

  int fd_;
  std::uint64_t number_;
  std::string client_;
  AnswerQueue& queue_;
  Clock::time_point moved_, deadline_;
  std::string asked_;
  std::vector<std::uint8_t> waiting_;
  std::size_t sent_ = 0;
  std::uint64_t taken_ = 0;  ///< bytes of the answer that the system has accepted
  FilePart file_;
  bool waits_ = false, closes_ = false, lingers_ = false;
};

using Connections = std::vector<std::unique_ptr<Connection>>;

/// Closes, among the connections of a kind, the one longest without progress; false if there is none.
template <class IsOfKind>
bool close_stuck(Connections& connections, const IsOfKind& is_of_kind) {
  auto stuck = connections.end();
  for (auto one = connections.begin(); one != connections.end(); ++one) {
    const bool counts = !(*one)->waits() && is_of_kind(**one);
    if (counts && (stuck == connections.end() || (*one)->last_progress() < (*stuck)->last_progress())) stuck = one;
  }
  if (stuck == connections.end()) return false;
  connections.erase(stuck);
  return true;
}

/// Makes room for another connection of a client. False if all candidates wait for the server or just received bytes.
bool make_place(Connections& connections, std::size_t places, const std::string& client) {
  const Clock::time_point now = Clock::now();
  const auto is_of_client = [&](const Connection& one) { return one.client() == client; };
  const auto is_stuck = [&](const Connection& one) { return one.last_progress() <= now; };
  const auto taken = std::ranges::count_if(connections, [&](const auto& one) { return is_of_client(*one); });
  if (static_cast<std::size_t>(taken) >= places / kShareOfAddress)
    return close_stuck(connections, [&](const Connection& one) { return is_of_client(one) && is_stuck(one); });
  return connections.size() < places || close_stuck(connections, is_stuck);
}

/// Closes clients that do not receive their answers, before the answers fill the memory.
void limit_waiting_bytes(Connections& connections) {
  const auto waits = [](const Connection& one) { return one.waiting_bytes() > 0; };
  while (true) {
    std::size_t waiting = 0;
    for (const auto& one : connections) waiting += one->waiting_bytes();
    if (waiting <= kMostWaitingBytes || !close_stuck(connections, waits)) return;
  }
}

/// "127.0.0.1", or "[::1]" as in URLs.
std::string host_in_url(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

struct AddressCloser {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};

}  // namespace

Result<HttpServer> HttpServer::listen(const std::string& host, int port) {
  addrinfo hints = {};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* list = nullptr;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list) != 0 || list == nullptr)
    return fail(ErrorKind::kUsage, fmt::format("--host {} is no address of this machine", shell_word(host)));
  const std::unique_ptr<addrinfo, AddressCloser> addresses(list);
  const int fd = ::socket(list->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  if (fd >= 0) ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (fd < 0 || ::bind(fd, list->ai_addr, list->ai_addrlen) != 0 || ::listen(fd, SOMAXCONN) != 0) {
    const int error = errno;
    if (fd >= 0) ::close(fd);
    if (error == EADDRINUSE)
      return fail(ErrorKind::kUsage, fmt::format("port {} is in use: give another one by --port, or 0 for any", port));
    if (error == EADDRNOTAVAIL)
      return fail(ErrorKind::kUsage, fmt::format("--host {} is no address of this machine", shell_word(host)));
    return fail(ErrorKind::kUsage,
                fmt::format("cannot serve at {}:{}: {}", host_in_url(host), port, std::strerror(error)));
  }
  sockaddr_storage bound = {};
  socklen_t size = sizeof bound;
  std::array<char, NI_MAXSERV> service{};
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&bound), &size) == 0)
    ::getnameinfo(reinterpret_cast<sockaddr*>(&bound), size, nullptr, 0, service.data(), service.size(),
                  NI_NUMERICSERV);
  return HttpServer(fd, fmt::format("http://{}:{}/", host_in_url(host), service.data()));
}

HttpServer::HttpServer(HttpServer&& other) noexcept : fd_(std::exchange(other.fd_, -1)), url_(std::move(other.url_)) {}
HttpServer& HttpServer::operator=(HttpServer&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(url_, other.url_);
  return *this;
}
HttpServer::~HttpServer() {
  if (fd_ >= 0) ::close(fd_);
}

Result<void> HttpServer::run(const std::function<Response(const Request&)>& answer, int threads,
                             const std::function<bool()>& is_over) {
  AnswerQueue queue(threads, answer);
  const std::size_t places = find_places();
  const auto is_any = [](const Connection&) { return true; };
  Connections connections;
  const auto has_room = [&] {
    return connections.size() < places ||
           std::ranges::any_of(connections, [](const auto& one) { return !one->waits(); });
  };
  std::vector<pollfd> watched;
  std::uint64_t accepted = 0;
  while (!is_over()) {
    watched.clear();
    for (const auto& connection : connections) watched.push_back({connection->fd(), connection->events(), 0});
    watched.push_back({queue.wake_fd(), POLLIN, 0});
    const bool accepts = has_room();
    if (accepts) watched.push_back({fd_, POLLIN, 0});
    if (::poll(watched.data(), watched.size(), kPollMilliseconds) < 0) {
      if (errno == EINTR) continue;
      return fail(ErrorKind::kOutput, fmt::format("cannot wait for requests: {}", std::strerror(errno)));
    }
    const Clock::time_point now = Clock::now();
    for (std::size_t k = 0; k < connections.size(); ++k) {
      Connection& one = *connections[k];
      const short seen = watched[k].revents, wanted = one.events();
      bool stays = !one.is_late(now) && (seen & (POLLERR | POLLNVAL)) == 0;
      if (stays && (seen & POLLHUP) != 0 && wanted == 0) stays = false;
      if (stays && (seen & (POLLIN | POLLHUP)) != 0 && wanted == POLLIN) stays = one.receive();
      if (stays && (seen & POLLOUT) != 0) stays = one.send();
      if (!stays) connections[k].reset();
    }
    std::erase(connections, nullptr);
    for (AnswerQueue::Done& done : queue.take()) {
      // Connections are sorted by number.
      const auto found = std::lower_bound(
          connections.begin(), connections.end(), done.client,
          [](const std::unique_ptr<Connection>& one, std::uint64_t number) { return one->number() < number; });
      if (found != connections.end() && (*found)->number() == done.client) (*found)->take(std::move(done));
    }
    limit_waiting_bytes(connections);
    if (!accepts || (watched.back().revents & POLLIN) == 0) continue;
    for (int k = 0; k < kMostAcceptedAtOnce && has_room(); ++k) {
      sockaddr_storage address{};
      socklen_t size = sizeof address;
      const int fd = ::accept4(fd_, reinterpret_cast<sockaddr*>(&address), &size, SOCK_CLOEXEC | SOCK_NONBLOCK);
      if (fd < 0) {
        // The process has reached its limit of open files.
        if (errno == EMFILE || errno == ENFILE) close_stuck(connections, is_any);
        break;
      }
      std::string client = client_of(address);
      if (!make_place(connections, places, client)) {
        ::close(fd);
        continue;
      }
      const int on = 1;
      ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      ::setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kMostUnsent, sizeof kMostUnsent);
      connections.push_back(std::make_unique<Connection>(fd, ++accepted, std::move(client), queue));
    }
  }
  return {};
}

}  // namespace scarp::cli
