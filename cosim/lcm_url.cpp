#include "cosim/lcm_url.hpp"

#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include <arpa/inet.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr const char* kProvider = "udpm://";

/// What a URL is read with: every complaint names the whole of it.
class Reader {
 public:
  explicit Reader(const std::string& url) : url_(url) {}

  LcmUrl read() {
    if (url_.compare(0, std::strlen(kProvider), kProvider) != 0) {
      throw InputError(
          fmt::format("LCM cannot use the URL '{}'; it must begin with {}. Try: "
                      "udpm://239.255.76.67:7667?ttl=0",
                      url_, kProvider));
    }
    const std::size_t begin = std::strlen(kProvider);
    const std::size_t question = url_.find('?');
    readAddress(url_.substr(begin, question - begin));
    if (question != std::string::npos) readOptions(url_.substr(question + 1));
    return out_;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(
        fmt::format("LCM URL '{}': {}. Try: udpm://239.255.76.67:7667?ttl=0", url_, why));
  }

  // Digits and nothing else: no sign, no blank, no other base.
  static std::optional<long> wholeNumber(const std::string& text) {
    if (text.empty() || text.size() > 10) return std::nullopt;
    if (text.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    return std::stol(text);
  }

  void readAddress(const std::string& host_port) {
    const std::size_t colon = host_port.find(':');
    if (colon == std::string::npos) refuse("no port");
    const std::string host = host_port.substr(0, colon);
    in_addr address{};
    if (inet_pton(AF_INET, host.c_str(), &address) != 1) {
      refuse(fmt::format("'{}' is no IPv4 address", host));
    }
    if (!IN_MULTICAST(ntohl(address.s_addr))) {
      refuse("not a multicast address (224.0.0.0 to 239.255.255.255)");
    }
    const std::optional<long> port = wholeNumber(host_port.substr(colon + 1));
    if (!port || *port < 1 || *port > 65535) refuse("the port must be 1 to 65535");
    out_.group = host;
    out_.port = static_cast<std::uint16_t>(*port);
  }

  void readOptions(const std::string& options) {
    for (std::size_t begin = 0; begin <= options.size();) {
      const std::size_t end = std::min(options.find('&', begin), options.size());
      readOption(options.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  void readOption(const std::string& option) {
    const std::size_t equals = std::min(option.find('='), option.size());
    const std::string name = option.substr(0, equals);
    const std::string value = option.substr(std::min(equals + 1, option.size()));
    if (!seen_.insert(name).second) refuse(fmt::format("option '{}' stands there twice", name));
    if (name == "ttl") {
      out_.ttl = number(name, value, 0, 255);
    } else if (name == "recv_buf_size") {
      out_.receive_buffer_bytes = number(name, value, 1, std::numeric_limits<int>::max());
    } else {
      refuse(fmt::format("unknown option '{}'; there are ttl and recv_buf_size", name));
    }
  }

  int number(const std::string& name, const std::string& value, long least, long most) const {
    const std::optional<long> parsed = wholeNumber(value);
    if (!parsed || *parsed < least || *parsed > most) {
      refuse(fmt::format("{} is '{}', must be a whole number from {} to {}", name, value, least,
                         most));
    }
    return static_cast<int>(*parsed);
  }

  const std::string& url_;
  LcmUrl out_;
  std::set<std::string> seen_;
};

}  // namespace

LcmUrl LcmUrl::parse(const std::string& url) { return Reader(url).read(); }

std::string LcmUrl::network() const { return fmt::format("{}:{}", group, port); }

}  // namespace ballbot
