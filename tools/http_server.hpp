#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace ballbot {

/// Texts that come one after the other, for a browser's EventSource.
class EventSource {
 public:
  virtual ~EventSource() = default;
  /// Waits for a text newer than number `seen`, and takes the newest: false after `timeout`.
  virtual bool next(std::uint64_t& seen, std::string& out, std::chrono::milliseconds timeout) = 0;
};

/// Serves pages to a browser on this machine, and to nobody else: it listens on 127.0.0.1, and
/// answers only requests that name this machine as their host, so that a page from elsewhere whose
/// name was made to point here (DNS rebinding) reads nothing. One thread and one poll() for all: no
/// client, however slow, keeps another or the end waiting.
class HttpServer {
 public:
  /// @param port  0: any that is free
  /// @throw InputError if the port is taken.
  explicit HttpServer(int port);
  ~HttpServer();

  /// e.g. "http://127.0.0.1:8080/"
  std::string url() const;

  /// Answers GET `path` with what `text` gives at that time.
  void onGet(const std::string& path, const std::string& content_type,
             std::function<std::string()> text);
  /// Streams `source` at `path` as server-sent events. It must outlive serve().
  void onEvents(const std::string& path, EventSource& source);

  /// Serves until `stop` is set.
  void serve(const std::atomic<bool>& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
