#include "fmi/coupling_graph.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"
#include "fmi/array_element.hpp"

namespace ballbot {
namespace {

std::size_t sizeOf(const std::vector<CouplingPort>& ports) {
  return ports.empty() ? 0 : ports.back().offset + ports.back().size;
}

bool overlap(std::size_t a, std::size_t a_size, std::size_t b, std::size_t b_size) {
  return a < b + b_size && b < a + a_size;
}

std::string didYouMean(const std::string& word, const std::set<std::string>& candidates) {
  const std::string near = nearestWord(word, candidates);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

/// The part of a port that `name` stands for: all of it, or one element.
std::optional<CouplingPort> partOf(const CouplingPort& port, const std::string& name) {
  std::vector<std::string> names = port.aliases;
  names.push_back(port.name);
  const auto called = [&](const std::string& text) {
    return std::find(names.begin(), names.end(), text) != names.end();
  };
  if (called(name)) return port;
  const auto parts = splitElement(name);
  if (!parts || !called(parts->first)) return std::nullopt;
  const auto place = elementOffset(
      parts->second, port.dimensions.empty() ? std::vector{port.size} : port.dimensions,
      port.first_index);
  if (!place) return std::nullopt;
  CouplingPort one = port;
  one.name = name;
  one.offset += *place;
  one.size = 1;
  return one;
}

/// The end of a connection: a whole port, or one element of it.
CouplingPort findEnd(const CouplingNode& node, const std::vector<CouplingPort>& ports,
                     const std::string& name, const char* kind, const SourceLocation& where) {
  std::set<std::string> names;
  for (const CouplingPort& port : ports) {
    names.insert(node.name + "." + port.name);
    if (auto part = partOf(port, name)) return *std::move(part);
  }
  const std::string full = node.name + "." + name;
  throw InputError(fmt::format("{}: '{}' has no {} '{}'{}", toText(where), node.name, kind, name,
                               didYouMean(full, names)));
}

const char* unitText(const CouplingPort& port) {
  return port.unit.name.empty() ? "1" : port.unit.name.c_str();
}

}  // namespace

std::size_t CouplingNode::inputSize() const { return sizeOf(inputs); }
std::size_t CouplingNode::outputSize() const { return sizeOf(outputs); }

void CouplingNode::add(std::vector<CouplingPort>& ports, CouplingPort port) {
  port.offset = sizeOf(ports);
  ports.push_back(std::move(port));
}

CouplingGraph::CouplingGraph(std::vector<CouplingNode> nodes,
                             const std::vector<CouplingLine>& lines)
    : nodes_(std::move(nodes)) {
  for (const CouplingLine& line : lines) connect(line);
  order();
}

std::size_t CouplingGraph::find(const std::string& name) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].name == name) return i;
  }
  throw InputError(fmt::format("there is no participant '{}'", name));
}

void CouplingGraph::connect(const CouplingLine& line) {
  std::set<std::string> names;
  for (const CouplingNode& node : nodes_) names.insert(node.name);
  const auto nodeOf = [&](const std::string& text) {
    const std::string name = text.substr(0, text.find('.'));
    if (names.count(name) == 0) {
      throw InputError(fmt::format("{}: '{}' names no participant; there are: {}",
                                   toText(line.where), text, fmt::join(names, ", ")));
    }
    return find(name);
  };
  const auto portOf = [](const std::string& text) {
    const std::size_t dot = text.find('.');
    return dot == std::string::npos ? std::string() : text.substr(dot + 1);
  };
  const std::size_t from = nodeOf(line.from), to = nodeOf(line.to);
  const CouplingPort source =
      findEnd(nodes_[from], nodes_[from].outputs, portOf(line.from), "output", line.where);
  const CouplingPort sink =
      findEnd(nodes_[to], nodes_[to].inputs, portOf(line.to), "input", line.where);

  if (source.size != sink.size) {
    throw InputError(fmt::format("{}: '{}' has {} values, '{}' takes {}", toText(line.where),
                                 line.from, source.size, line.to, sink.size));
  }
  if (!fitsWithoutLoss(source.kind, sink.kind)) {
    throw InputError(fmt::format(
        "{}: '{}' is {}, but '{}' takes {}; something could be lost. Convert it in one of the FMUs",
        toText(line.where), line.from, toText(source.kind), line.to, toText(sink.kind)));
  }
  // FMUs of others often say no unit; what is said must agree.
  const bool said = !source.unit.name.empty() && !sink.unit.name.empty();
  if (said && !sameUnit(source.unit, sink.unit)) {
    throw InputError(fmt::format("{}: '{}' is in {}, but '{}' in {}", toText(line.where), line.from,
                                 unitText(source), line.to, unitText(sink)));
  }
  for (const Copy& other : copies_) {
    if (other.to_node == to && overlap(other.to, other.size, sink.offset, sink.size)) {
      throw InputError(
          fmt::format("{}: '{}' has another source already", toText(line.where), line.to));
    }
  }
  copies_.push_back({from, source.offset, to, sink.offset, source.size, line.delayed});
}

void CouplingGraph::gather(std::size_t node, const std::vector<std::vector<double>>& outputs,
                           const std::vector<std::vector<double>>& before,
                           std::vector<double>& inputs) const {
  for (const Copy& c : copies_) {
    if (c.to_node != node) continue;
    const std::vector<double>& from = (c.delayed ? before : outputs)[c.from_node];
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(c.from), c.size,
                inputs.begin() + static_cast<std::ptrdiff_t>(c.to));
  }
}

bool CouplingGraph::fed(std::size_t node, const CouplingPort& input) const {
  std::size_t values = 0;
  for (const Copy& c : copies_) {
    if (c.to_node == node && overlap(c.to, c.size, input.offset, input.size)) values += c.size;
  }
  return values == input.size;
}

bool CouplingGraph::used(std::size_t node, const CouplingPort& output) const {
  return std::any_of(copies_.begin(), copies_.end(), [&](const Copy& c) {
    return c.from_node == node && overlap(c.from, c.size, output.offset, output.size);
  });
}

/// Whether output `b` changes at once when output `a` does.
bool CouplingGraph::acts(const Output& a, const Output& b) const {
  const CouplingPort& from = nodes_[a.node].outputs[a.port];
  for (const std::size_t i : nodes_[b.node].outputs[b.port].depends_on) {
    const CouplingPort& input = nodes_[b.node].inputs[i];
    for (const Copy& c : copies_) {
      if (!c.delayed && c.from_node == a.node && c.to_node == b.node &&
          overlap(c.from, c.size, from.offset, from.size) &&
          overlap(c.to, c.size, input.offset, input.size)) {
        return true;
      }
    }
  }
  return false;
}

/// Whether another model or the controller takes the output's value, now or delayed.
bool CouplingGraph::awaited(const Output& output) const {
  const CouplingPort& port = nodes_[output.node].outputs[output.port];
  return std::any_of(copies_.begin(), copies_.end(), [&](const Copy& c) {
    return c.from_node == output.node && nodes_[c.to_node].name != kRecordName &&
           overlap(c.from, c.size, port.offset, port.size);
  });
}

/// Sorts the outputs so that each comes after those it depends on; among equals, as declared.
void CouplingGraph::order() {
  std::vector<Output> outputs;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    for (std::size_t p = 0; p < nodes_[n].outputs.size(); ++p) outputs.push_back({n, p});
  }
  std::vector<char> done(outputs.size(), 0), late(outputs.size(), 0);
  for (std::size_t count = 0; count < outputs.size(); ++count) {
    std::size_t next = outputs.size();
    for (std::size_t b = 0; b < outputs.size() && next == outputs.size(); ++b) {
      bool ready = done[b] == 0;
      for (std::size_t a = 0; a < outputs.size() && ready; ++a) {
        ready = done[a] != 0 || !acts(outputs[a], outputs[b]);
      }
      if (ready) next = b;
    }
    if (next == outputs.size()) refuseLoop(outputs, done);
    done[next] = 1;
    const Output& b = outputs[next];
    const bool controller = nodes_[b.node].name == kControllerName;
    for (std::size_t a = 0; a < outputs.size(); ++a) {
      if (!acts(outputs[a], b)) continue;
      if (late[a] != 0 || nodes_[outputs[a].node].name == kControllerName) late[next] = 1;
    }
    const bool through = !nodes_[b.node].outputs[b.port].depends_on.empty() && awaited(b);
    std::vector<std::size_t>& list = late[next] != 0 ? after_ : before_;
    if (through && !controller && (list.empty() || list.back() != b.node)) list.push_back(b.node);
  }
}

void CouplingGraph::refuseLoop(const std::vector<Output>& outputs,
                               const std::vector<char>& done) const {
  // Whoever waits, waits for another who waits: going back along that ends in the loop.
  const auto waitsFor = [&](std::size_t b) {
    for (std::size_t a = 0; a < outputs.size(); ++a) {
      if (done[a] == 0 && acts(outputs[a], outputs[b])) return a;
    }
    return b;
  };
  std::size_t at = static_cast<std::size_t>(std::find(done.begin(), done.end(), 0) - done.begin());
  std::vector<std::size_t> path;
  while (std::find(path.begin(), path.end(), at) == path.end()) {
    path.push_back(at);
    at = waitsFor(at);
  }
  path.erase(path.begin(), std::find(path.begin(), path.end(), at));
  path.push_back(at);
  std::vector<std::string> names;
  for (auto it = path.rbegin(); it != path.rend(); ++it) {
    const Output& o = outputs[*it];
    names.push_back(nodes_[o.node].name + "." + nodes_[o.node].outputs[o.port].name);
  }
  throw InputError(
      fmt::format("fmus: these outputs depend on each other within one instant: {}. Break the loop "
                  "with 'delay_steps: 1' on one of its connections",
                  fmt::join(names, " -> ")));
}

}  // namespace ballbot
