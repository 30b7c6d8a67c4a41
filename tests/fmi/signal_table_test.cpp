#include "model/signal_table.hpp"

#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

struct Field {
  int size = 1;
  std::set<std::string> units;
};

/// The fields of a message as its definition has them, with every unit in brackets behind them.
std::map<std::string, Field> fieldsOf(const std::string& message) {
  std::ifstream in(BALLBOT_SOURCE_DIR "/messages/" + message + ".lcm");
  const std::regex field(R"(^\s+\w+\s+(\w+)(\[(\d+)\])?;\s*//(.*)$)"), unit(R"(\[([^\]]+)\])");
  std::map<std::string, Field> out;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, field)) continue;
    Field f;
    if (match[3].matched) f.size = std::stoi(match[3]);
    const std::string comment = match[4];
    for (std::sregex_iterator it(comment.begin(), comment.end(), unit), end; it != end; ++it)
      f.units.insert((*it)[1]);
    out[match[1]] = f;
  }
  for (const char* bookkeeping : {"checksum", "tick", "sim_time_ns"}) out.erase(bookkeeping);
  return out;
}

/// Every field of the message is in the table, whole and with the unit it has there.
template <typename Frame>
void expectSame(const std::string& message, const std::vector<Signal<Frame>>& signals) {
  const auto fields = fieldsOf(message);
  ASSERT_GT(fields.size(), 4U);
  for (const auto& [name, field] : fields) {
    int covered = 0;
    for (const auto& s : signals) {
      if (s.message_field != name) continue;
      covered += s.size;
      if (s.kind == SignalKind::kTime) {
        EXPECT_EQ(field.units, std::set<std::string>{"ns"}) << name;
      } else {
        // A field may name several units: "px, py [m]; yaw, pitch, roll [rad]".
        const bool none = field.units.empty() && *s.unit == '\0';
        EXPECT_TRUE(none || field.units.count(s.unit) == 1)
            << message << "." << name << " in " << s.unit;
      }
    }
    EXPECT_EQ(covered, field.size)
        << message << "." << name << " is not in model/signal_table.cpp, or not whole";
  }
}

TEST(SignalTable, HasEveryFieldOfTheMessages) {
  expectSame("actuator_command", commandSignals());
  expectSame("sensor_frame", sensorSignals());
  expectSame("truth_frame", truthSignals());
}

template <typename Frame>
void expectRoundTrip(const std::vector<Signal<Frame>>& signals) {
  Frame frame;
  double next = 0.1;
  std::set<std::string> names;
  for (const auto& s : signals) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name << " stands twice";
    std::vector<double> in(static_cast<std::size_t>(s.size)), out(in.size());
    for (double& value : in)
      value = s.kind == SignalKind::kCount ? 3 : 1e-9 * std::round(1e9 * (next *= 1.37));
    s.write(frame, in.data());
    s.read(frame, out.data());
    if (s.kind == SignalKind::kTime) {
      EXPECT_EQ(std::llround(1e9 * in[0]), std::llround(1e9 * out[0])) << s.name;
    } else {
      EXPECT_EQ(in, out) << s.name;
    }
  }
}

TEST(SignalTable, WhatIsWrittenIsRead) {
  expectRoundTrip(commandSignals());
  expectRoundTrip(externalForceSignals());
  expectRoundTrip(sensorSignals());
  expectRoundTrip(truthSignals());
}

}  // namespace
}  // namespace ballbot
