#pragma once

#include <cstddef>
#include <string>

namespace ballbot {

/// A request is no longer, up to the empty line that ends its header.
constexpr std::size_t kMaxRequestBytes = 8192;

/// How a request is to be answered: 200, or the reason why not.
struct HttpRequest {
  int status = 400;
  std::string path;  ///< without query
};

/// Reads a whole request header, from the request line to the empty line. The host must be
/// 127.0.0.1, localhost or [::1], with any port, as through a forwarded one.
/// Status 405: not GET; 421: another host; 400: anything malformed.
HttpRequest parseHttpRequest(const std::string& text);

/// The standard's words for a status; for one of ours, what to do.
std::string httpReason(int status);

/// The line and header fields before a body; `length` negative: it ends with the connection.
std::string httpHeader(int status, const std::string& content_type, long length);

}  // namespace ballbot
