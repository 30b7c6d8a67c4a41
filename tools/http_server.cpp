#include "tools/http_server.hpp"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <list>
#include <map>
#include <vector>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.hpp"
#include "tools/http_request.hpp"

namespace ballbot {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr char kHost[] = "127.0.0.1";
// So often streams are fed and the stop flag is looked at.
constexpr milliseconds kTick{20};
// A request must be there, and a client must have read on, within this.
constexpr milliseconds kPatience{5'000};
// A comment that finds out whether a browser is still there.
constexpr milliseconds kHeartbeat{200};
// With more, the one that has waited longest for its request gives way, else the oldest.
constexpr std::size_t kMaxConnections = 64;

/// What a path gives: a page, or a stream of events.
struct Resource {
  std::string content_type;
  std::function<std::string()> text;
  EventSource* events = nullptr;
};

struct Connection {
  explicit Connection(int socket) : fd(socket) {}
  ~Connection() { ::close(fd); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool waiting() const { return !answered; }                    ///< for its request
  bool idle() const { return answered && sent == out.size(); }  ///< nothing to send now

  int fd;
  std::string in, out;
  std::size_t sent = 0;
  bool answered = false;
  EventSource* events = nullptr;  ///< set: more follows
  std::uint64_t seen = 0;
  Clock::time_point progress = Clock::now(), last_event{};
};

int listenOn(int& port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (::bind(fd, generic, size) != 0 || ::listen(fd, SOMAXCONN) != 0 ||
      ::getsockname(fd, generic, &size) != 0) {
    ::close(fd);
    throw InputError(
        fmt::format("port {} of {} cannot be used; is something else serving there? "
                    "--port 0 takes any that is free",
                    port, kHost));
  }
  port = ntohs(address.sin_port);
  return fd;
}

}  // namespace

struct HttpServer::Impl {
  explicit Impl(int wanted_port) : port(wanted_port), listener(listenOn(port)) {}
  ~Impl() { ::close(listener); }

  void turn();
  void acceptAll();
  bool read(Connection& c);
  void answer(Connection& c);
  void feed(Connection& c, Clock::time_point now);
  bool write(Connection& c);

  int port;
  int listener;
  std::map<std::string, Resource> resources;
  std::list<Connection> connections;  // the oldest first
};

// One round: waits until somebody can go on, then does for each what can be done without waiting.
void HttpServer::Impl::turn() {
  std::vector<pollfd> waiting{{listener, POLLIN, 0}};
  for (const Connection& c : connections) {
    const int events = POLLIN | (c.sent < c.out.size() ? POLLOUT : 0);
    waiting.push_back({c.fd, static_cast<short>(events), 0});
  }
  (void)::poll(waiting.data(), waiting.size(), static_cast<int>(kTick.count()));
  const Clock::time_point now = Clock::now();
  std::size_t i = 1;
  for (auto c = connections.begin(); c != connections.end(); ++i) {
    bool lives = waiting[i].revents == 0 || read(*c);
    if (lives && c->events != nullptr && c->idle()) feed(*c, now);
    lives = lives && write(*c);
    // A page that is sent is done; a client that neither asks nor reads is given up.
    const bool done = c->idle() && c->events == nullptr;
    const bool stuck = !c->idle() && now - c->progress > kPatience;
    c = !lives || done || stuck ? connections.erase(c) : std::next(c);
  }
  if (waiting[0].revents != 0) acceptAll();
}

void HttpServer::Impl::acceptAll() {
  for (;;) {
    const int fd = ::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) return;
    if (connections.size() == kMaxConnections) {
      const auto slow = std::find_if(connections.begin(), connections.end(),
                                     [](const Connection& c) { return c.waiting(); });
      connections.erase(slow != connections.end() ? slow : connections.begin());
    }
    connections.emplace_back(fd);
  }
}

// False once the client has gone.
bool HttpServer::Impl::read(Connection& c) {
  char buffer[4096];
  const ssize_t count = ::recv(c.fd, buffer, sizeof buffer, 0);
  if (count == 0) return false;
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  if (c.answered) return true;  // nothing more is asked for; what comes is dropped
  c.in.append(buffer, static_cast<std::size_t>(count));
  const bool whole = c.in.find("\r\n\r\n") != std::string::npos;
  if (whole || c.in.size() > kMaxRequestBytes) answer(c);
  return true;
}

void HttpServer::Impl::answer(Connection& c) {
  c.answered = true;
  c.progress = Clock::now();
  const HttpRequest request =
      c.in.size() > kMaxRequestBytes ? HttpRequest{} : parseHttpRequest(c.in);
  int status = request.status;
  const auto resource = resources.find(request.path);
  if (status == 200 && resource == resources.end()) status = 404;
  if (status == 200 && resource->second.events != nullptr) {
    c.events = resource->second.events;
    c.out = httpHeader(200, resource->second.content_type, -1);
    return;
  }
  std::string type = "text/plain; charset=utf-8", body = httpReason(status);
  if (status == 200) {
    try {
      body = resource->second.text();
      type = resource->second.content_type;
    } catch (const std::exception&) {  // e.g. the file has been deleted meanwhile
      status = 500;
      body = httpReason(status);
    }
  }
  c.out = httpHeader(status, type, static_cast<long>(body.size())) + body;
}

void HttpServer::Impl::feed(Connection& c, Clock::time_point now) {
  std::string text;
  const bool news = c.events->next(c.seen, text, milliseconds{0});
  if (!news && now - c.last_event < kHeartbeat) return;
  c.out = news ? "data: " + text + "\n\n" : ": waiting\n\n";
  c.sent = 0;
  c.last_event = c.progress = now;
}

bool HttpServer::Impl::write(Connection& c) {
  if (c.sent == c.out.size()) return true;
  const ssize_t count = ::send(c.fd, c.out.data() + c.sent, c.out.size() - c.sent, MSG_NOSIGNAL);
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  c.sent += static_cast<std::size_t>(count);
  if (count > 0) c.progress = Clock::now();
  return true;
}

HttpServer::HttpServer(int port) : impl_(std::make_unique<Impl>(port)) {}

HttpServer::~HttpServer() = default;

std::string HttpServer::url() const { return fmt::format("http://{}:{}/", kHost, impl_->port); }

void HttpServer::onGet(const std::string& path, const std::string& content_type,
                       std::function<std::string()> text) {
  impl_->resources[path] = {content_type, std::move(text), nullptr};
}

void HttpServer::onEvents(const std::string& path, EventSource& source) {
  impl_->resources[path] = {"text/event-stream", nullptr, &source};
}

void HttpServer::serve(const std::atomic<bool>& stop) {
  while (!stop.load()) impl_->turn();
  impl_->connections.clear();
}

}  // namespace ballbot
