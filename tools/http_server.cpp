#include "tools/http_server.hpp"

#include <sys/socket.h>

#include <future>
#include <thread>

#include <fmt/format.h>
#include <httplib.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr char kHost[] = "127.0.0.1";
constexpr auto kPatience = std::chrono::milliseconds(200);

}  // namespace

struct HttpServer::Impl {
  httplib::Server server;
  int port = 0;
  std::atomic<bool> stopping{false};
};

HttpServer::HttpServer(int port) : impl_(std::make_unique<Impl>()) {
  httplib::Server& server = impl_->server;
  // The library's default lets a second server share the port of a first.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  if (port == 0) {
    impl_->port = server.bind_to_any_port(kHost);
  } else if (server.bind_to_port(kHost, port)) {
    impl_->port = port;
  }
  if (impl_->port <= 0) {
    throw InputError(fmt::format("port {} of {} cannot be used; is something else serving there? "
                                 "--port 0 takes any that is free", port, kHost));
  }
  // A page from elsewhere must not read what is served here.
  server.set_default_headers({{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
}

HttpServer::~HttpServer() = default;

std::string HttpServer::url() const { return fmt::format("http://{}:{}/", kHost, impl_->port); }

void HttpServer::onGet(const std::string& path, const std::string& content_type,
                       std::function<std::string()> text) {
  impl_->server.Get(path, [content_type, text = std::move(text)](const httplib::Request&,
                                                                 httplib::Response& response) {
    response.set_content(text(), content_type);
  });
}

void HttpServer::onEvents(const std::string& path, EventSource& source) {
  const auto answer = [this, &source](const httplib::Request&, httplib::Response& response) {
    auto seen = std::make_shared<std::uint64_t>(0);
    response.set_chunked_content_provider(
        "text/event-stream", [this, &source, seen](std::size_t, httplib::DataSink& sink) {
          std::string text;
          if (impl_->stopping.load()) {
            sink.done();
            return true;
          }
          // A comment keeps the connection alive and finds out when the browser has gone.
          const bool news = source.next(*seen, text, kPatience);
          const std::string event = news ? "data: " + text + "\n\n" : ": waiting\n\n";
          return sink.write(event.data(), event.size());
        });
  };
  impl_->server.Get(path, answer);
}

void HttpServer::serve(const std::atomic<bool>& stop) {
  const std::future<bool> served =
      std::async(std::launch::async, [this] { return impl_->server.listen_after_bind(); });
  while (!stop.load()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  impl_->stopping.store(true);
  // A server that does not listen yet would not hear stop(): Ctrl-C in the first instant.
  while (!impl_->server.is_running() &&
         served.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
  }
  impl_->server.stop();
}

}  // namespace ballbot
