#include "tools/http_request.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr const char* kLineEnd = "\r\n";

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// A name that always means this machine. A browser sends the name in its address bar, so a name of
// somebody else's that only resolves to 127.0.0.1 shows here.
bool isThisMachine(const std::string& host) {
  for (const char* name : {"127.0.0.1", "localhost", "[::1]"}) {
    const std::string own = name;
    if (host.compare(0, own.size(), own) != 0) continue;
    const std::string rest = host.substr(own.size());
    if (rest.empty()) return true;
    if (rest[0] == ':' && rest.size() > 1 &&
        rest.find_first_not_of("0123456789", 1) == std::string::npos) {
      return true;
    }
  }
  return false;
}

// The values of all Host fields: a request has exactly one.
bool hostIsThisMachine(const std::string& text, std::size_t fields_begin, int& status) {
  int hosts = 0;
  bool ours = false;
  for (std::size_t begin = fields_begin; begin < text.size();) {
    const std::size_t end = std::min(text.find(kLineEnd, begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 2;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || lower(line.substr(0, colon)) != "host") continue;
    ++hosts;
    ours = isThisMachine(lower(trimmed(line.substr(colon + 1))));
  }
  status = hosts != 1 ? 400 : ours ? 200 : 421;
  return status == 200;
}

const char* reason(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 421:
      return "Misdirected Request";
    case 500:
      return "Internal Server Error";
    default:
      return "Bad Request";
  }
}

}  // namespace

std::string httpReason(int status) {
  std::string text = fmt::format("{} {}\n", status, reason(status));
  if (status == 421)
    text += "This server answers to 127.0.0.1 and localhost only: use that name.\n";
  return text;
}

HttpRequest parseHttpRequest(const std::string& text) {
  HttpRequest out;
  const std::size_t line_end = text.find(kLineEnd);
  if (line_end == std::string::npos) return out;
  const std::string line = text.substr(0, line_end);
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string::npos || last == first) return out;
  if (line.compare(last + 1, 7, "HTTP/1.") != 0) return out;
  if (!hostIsThisMachine(text, line_end + 2, out.status)) return out;
  if (line.substr(0, first) != "GET") {
    out.status = 405;
    return out;
  }
  const std::string target = line.substr(first + 1, last - first - 1);
  out.path = target.substr(0, target.find('?'));
  if (out.path.empty() || out.path[0] != '/') out.status = 400;
  return out;
}

std::string httpHeader(int status, const std::string& content_type, long length) {
  // Nothing is kept or guessed, and no page from elsewhere may read or embed what is served here.
  std::string header = fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nCache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n"
      "Connection: close\r\n",
      status, reason(status), content_type);
  if (length >= 0) header += fmt::format("Content-Length: {}\r\n", length);
  return header + "\r\n";
}

}  // namespace ballbot
