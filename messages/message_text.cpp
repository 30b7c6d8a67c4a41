#include "messages/message_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "model/signal_table.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kWidth = 100;

struct Field {
  std::string type, name;  ///< name with its size: "q[8]"
  std::string words;
};

struct Message {
  std::string name, words;  ///< words: lines of a comment
  std::vector<Field> fields;
};

const char* lcmType(SignalKind kind) {
  switch (kind) {
    case SignalKind::kReal:
      return "double";
    case SignalKind::kCount:
    case SignalKind::kTime:
      return "int64_t";
    case SignalKind::kNumber:
      return "int32_t";
    case SignalKind::kCode:
      return "int8_t";
    case SignalKind::kFlag:
      return "boolean";
  }
  return "";
}

std::string wordsOf(const char* description, SignalKind kind, const std::string& unit) {
  const std::string shown = kind == SignalKind::kTime ? "ns" : unit;
  return shown.empty() ? description : fmt::format("{} [{}]", description, shown);
}

/// Rows that share a field follow one another.
template <typename Frame>
std::vector<Field> fieldsOf(const std::vector<Signal<Frame>>& signals) {
  std::vector<Field> out;
  for (std::size_t i = 0; i < signals.size();) {
    const std::string name = signals[i].message_field;
    Field field{lcmType(signals[i].kind), name, ""};
    int size = 0;
    for (; i < signals.size() && signals[i].message_field == name; ++i) {
      const auto& s = signals[i];
      size += s.size;
      field.words += (field.words.empty() ? "" : "; ") + wordsOf(s.description, s.kind, s.unit);
    }
    if (size > 1) field.name += fmt::format("[{}]", size);
    out.push_back(field);
  }
  return out;
}

template <typename Frame>
Message message(const char* name, const char* words, const char* time_words,
                const std::vector<Signal<Frame>>& signals) {
  Message m{name, words, {}};
  m.fields = {{"int64_t", "checksum", "of the encoded message; 0 inside another message"},
              {"int64_t", "tick", "number of the event; 0 inside a request or reply"},
              {"int64_t", "sim_time_ns", time_words}};
  for (const Field& f : fieldsOf(signals)) m.fields.push_back(f);
  return m;
}

std::vector<Message> messages() {
  return {
      message("actuator_command",
              "Controller -> plant or drives. Each drive applies, from sim_time_ns until the next\n"
              "command, torque + stiffness (position - joint_angle) + damping (velocity -\n"
              "joint_velocity). Joint order: wheels 1 to 3, then arm joints 1 to 3.",
              "simulated time from which it acts [ns]", commandSignals()),
      message("plan_report",
              "What happened in one solve of the planner. How long it took is a fact of the\n"
              "machine and is not in the log.",
              "simulated time of the state the plan starts from [ns]", planSignals()),
      message("sensor_frame",
              "Plant or drives -> controller: measured, never true, values. Joint order\n"
              "everywhere: wheels 1 to 3, then arm joints 1 to 3. Frames: W world, z up; B robot\n"
              "base, x forward.",
              "simulated time of the joint values [ns]", sensorSignals()),
      message("state_estimate",
              "What the controller knows about the robot. Frames: W world, z up; K ball centre; B\n"
              "robot base.",
              "simulated time it holds for [ns]", estimateSignals()),
      message("truth_frame",
              "The plant's true state, for the record and for judging a run. No controller\n"
              "receives it. Frames: W world, z up; K ball centre; B robot base; E end-effector.",
              "simulated time [ns]", truthSignals()),
  };
}

/// Behind `indent` columns, in lines of a comment that are not too long.
std::string wrapped(const std::string& words, std::size_t indent) {
  const std::size_t room = kWidth - indent - 3;
  std::string out, line;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string word = words.substr(begin, end - begin);
    if (!line.empty() && line.size() + 1 + word.size() > room) {
      out += line + "\n" + std::string(indent, ' ') + "// ";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return "// " + out + line;
}

std::string definition(const Message& m) {
  std::string text = "// Written by write_messages from model/signal_table.cpp. Change it there.\n";
  text += "package ballbot_msgs;\n\n";
  std::string words = m.words;
  for (std::size_t at = 0; (at = words.find('\n', at)) != std::string::npos; at += 4) {
    words.replace(at, 1, "\n// ");
  }
  text += "// " + words + "\nstruct " + m.name + " {\n";
  std::size_t name_width = 0;
  for (const Field& f : m.fields) name_width = std::max(name_width, f.name.size());
  for (const Field& f : m.fields) {
    const std::string begin = fmt::format("  {:<7} {:<{}} ", f.type, f.name + ";", name_width + 1);
    text += begin + " " + wrapped(f.words, begin.size() + 1) + "\n";
  }
  return text + "}\n";
}

std::string fieldsHeader() {
  std::string text =
      "// Written by write_messages from model/signal_table.cpp. Change it there.\n"
      "#pragma once\n\n";
  for (const Message& m : messages()) text += "#include \"ballbot_msgs/" + m.name + ".hpp\"\n";
  text +=
      "\nnamespace ballbot {\n\n"
      "// What a message carries of its frame, field by field in the order of the frame's "
      "signals.\n";
  for (const Message& m : messages()) {
    text += fmt::format(
        "\ntemplate <typename Visitor>\nvoid visitFields(ballbot_msgs::{}& m, Visitor&& visit) "
        "{{\n",
        m.name);
    for (std::size_t i = 3; i < m.fields.size(); ++i) {
      const std::string& name = m.fields[i].name;
      text += "  visit(m." + name.substr(0, name.find('[')) + ");\n";
    }
    text += "}\n";
  }
  return text + "\n}  // namespace ballbot\n";
}

}  // namespace

std::vector<WrittenFile> messageFiles() {
  std::vector<WrittenFile> out;
  for (const Message& m : messages()) out.push_back({m.name + ".lcm", definition(m)});
  out.push_back({"frame_fields.hpp", fieldsHeader()});
  return out;
}

}  // namespace ballbot
