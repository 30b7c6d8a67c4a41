#include "tools/http_server.hpp"

#include <list>
#include <thread>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tools/http_request.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

int statusOf(const std::string& text) { return parseHttpRequest(text).status; }

TEST(HttpRequest, IsAGetOfAPathOnThisMachine) {
  const HttpRequest r =
      parseHttpRequest("GET /a.json?x=1 HTTP/1.1\r\nhOST:  localhost:8080 \r\n\r\n");
  EXPECT_EQ(r.status, 200);
  EXPECT_EQ(r.path, "/a.json");
  EXPECT_EQ(statusOf("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"), 200);
  EXPECT_EQ(statusOf("GET / HTTP/1.1\r\nHost: [::1]:80\r\n\r\n"), 200);
  EXPECT_EQ(statusOf("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"), 405);
}

TEST(HttpRequest, OfAPageFromElsewhereIsRefused) {
  for (const char* host :
       {"evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example",
        "localhost:80.evil.example", "localhost:", "10.0.0.1", "[::1", ""}) {
    EXPECT_EQ(statusOf(std::string("GET / HTTP/1.1\r\nHost: ") + host + "\r\n\r\n"), 421) << host;
  }
  EXPECT_EQ(statusOf("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(statusOf("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n"), 400);
}

TEST(HttpRequest, ThatIsMalformedIsRefused) {
  for (const char* text :
       {"", "\r\n\r\n", "GET\r\n\r\n", "GET /\r\n\r\n", "GET / SPDY/9\r\nHost: localhost\r\n\r\n",
        "GET x HTTP/1.1\r\nHost: localhost\r\n\r\n"}) {
    EXPECT_EQ(statusOf(text), 400) << text;
  }
}

/// A client that sends and reads at its own pace.
class Client {
 public:
  explicit Client(const std::string& url) : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1))));
    const timeval patience{5, 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(::connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  ~Client() { ::close(fd_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  Client& say(const std::string& text) {
    EXPECT_EQ(::send(fd_, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
    return *this;
  }
  /// Until the server closes, or so many bytes are there.
  std::string hear(std::size_t most = std::string::npos) {
    std::string out;
    char buffer[4096];
    while (out.size() < most) {
      const ssize_t count = ::recv(fd_, buffer, sizeof buffer, 0);
      if (count <= 0) break;
      out.append(buffer, static_cast<std::size_t>(count));
    }
    return out;
  }

 private:
  int fd_;
};

std::string get(const std::string& path) {
  return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
}

class Counter final : public EventSource {
 public:
  bool next(std::uint64_t& seen, std::string& out, milliseconds) override {
    out = std::to_string(++seen);
    return true;
  }
};

/// A server in a thread of its own.
class HttpServerTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.onGet("/", "text/html", [] { return std::string(3'000'000, 'x'); });
    server_.onGet("/small", "text/plain", [] { return std::string("hello"); });
    server_.onGet("/gone", "text/plain", []() -> std::string { throw std::runtime_error("gone"); });
    server_.onEvents("/events", counter_);
    thread_ = std::thread([this] { server_.serve(stop_); });
  }
  void TearDown() override {
    const auto asked = Clock::now();
    stop_ = true;
    thread_.join();
    EXPECT_LT(Clock::now() - asked, milliseconds{1500}) << "no client may hold up the end";
  }
  std::string answerTo(const std::string& request) {
    return Client(server_.url()).say(request).hear();
  }

  Counter counter_;
  HttpServer server_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST_F(HttpServerTest, ServesPagesOfAnySize) {
  EXPECT_THAT(answerTo(get("/small")),
              testing::AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), HasSubstr("Content-Length: 5\r\n"),
                             testing::EndsWith("\r\n\r\nhello")));
  EXPECT_GT(answerTo(get("/")).size(), 3'000'000U);
  EXPECT_THAT(answerTo(get("/../etc/passwd")), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answerTo(get("/gone")), StartsWith("HTTP/1.1 500"));
  EXPECT_THAT(answerTo(std::string(20'000, 'A')), StartsWith("HTTP/1.1 400"));
}

TEST_F(HttpServerTest, AnswersNoPageWhoseNameWasMadeToPointHere) {
  EXPECT_THAT(answerTo("GET /small HTTP/1.1\r\nHost: evil.example\r\n\r\n"),
              testing::AllOf(StartsWith("HTTP/1.1 421"), HasSubstr("127.0.0.1 and localhost only"),
                             testing::Not(HasSubstr("hello"))));
}

TEST_F(HttpServerTest, StreamsEvents) {
  const std::string heard = Client(server_.url()).say(get("/events")).hear(250);
  EXPECT_THAT(heard, HasSubstr("text/event-stream"));
  EXPECT_THAT(heard, HasSubstr("\r\n\r\ndata: 1\n\ndata: 2\n\n"));
}

TEST_F(HttpServerTest, NoNumberOfSlowClientsKeepsAnotherWaiting) {
  std::list<Client> slow;
  for (int i = 0; i < 100; ++i) slow.emplace_back(server_.url()).say("GET / HT");  // no end
  for (int i = 0; i < 20; ++i) slow.emplace_back(server_.url()).say(get("/"));     // never read
  for (int i = 0; i < 20; ++i) slow.emplace_back(server_.url()).say(get("/events"));
  const auto asked = Clock::now();
  EXPECT_THAT(answerTo(get("/small")), testing::EndsWith("hello"));
  EXPECT_LT(Clock::now() - asked, milliseconds{2000});
}

}  // namespace
}  // namespace ballbot
