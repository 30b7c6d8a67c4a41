#include "messages/message_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "model/signal_table.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kWidth = 100;

struct Field {
  std::string type, name;  ///< name with its size: "p_WE[3]", "torque[joints]"
  std::string words;
};

struct Message {
  std::string name, words;  ///< words: lines of a comment
  std::vector<Field> fields;
  int first = 0;  ///< of the fields that come from the frame's signals
};

/// A size that depends on the robot is a field of its own, before those that have it.
struct Count {
  const char* name;
  const char* words;
};
constexpr Count kJoints{"joints", "actuators that the robot has: wheels and arm joints"};
constexpr Count kCoordinates{"coordinates", "of the robot: 5 and its arm joints"};

const Count* countOf(SignalExtent extent) {
  switch (extent) {
    case SignalExtent::kFixed:
      return nullptr;
    case SignalExtent::kPerJoint:
      return &kJoints;
    case SignalExtent::kPerArmJoint:
      return &kCoordinates;
  }
  return nullptr;
}

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
    const Count* count = nullptr;
    for (; i < signals.size() && signals[i].message_field == name; ++i) {
      const auto& s = signals[i];
      size += s.size;
      if (s.extent != SignalExtent::kFixed) count = countOf(s.extent);
      field.words += (field.words.empty() ? "" : "; ") + wordsOf(s.description, s.kind, s.unit);
    }
    if (count) {
      field.name += fmt::format("[{}]", count->name);
    } else if (size > 1) {
      field.name += fmt::format("[{}]", size);
    }
    out.push_back(field);
  }
  return out;
}

/// How many fields have that size.
int sizesBy(const Count& count, const std::vector<Field>& fields) {
  const std::string size = fmt::format("[{}]", count.name);
  return static_cast<int>(std::count_if(fields.begin(), fields.end(), [&](const Field& f) {
    return f.name.find(size) != std::string::npos;
  }));
}

template <typename Frame>
Message message(const char* name, const char* words, const char* time_words,
                const std::vector<Signal<Frame>>& signals) {
  Message m{name, words, {}, 0};
  m.fields = {{"int64_t", "checksum", "of the encoded message; 0 inside another message"},
              {"int64_t", "tick", "number of the event; 0 inside a request or reply"},
              {"int64_t", "sim_time_ns", time_words}};
  const std::vector<Field> fields = fieldsOf(signals);
  for (const Count& count : {kJoints, kCoordinates}) {
    if (sizesBy(count, fields) > 0) m.fields.push_back({"int32_t", count.name, count.words});
  }
  m.first = static_cast<int>(m.fields.size());
  m.fields.insert(m.fields.end(), fields.begin(), fields.end());
  return m;
}

std::vector<Message> messages() {
  return {
      message("actuator_command",
              "Controller -> plant or drives. Each drive applies, from sim_time_ns until the next\n"
              "command, torque + stiffness (position - joint_angle) + damping (velocity -\n"
              "joint_velocity). Joint order: wheels, then arm joints.",
              "simulated time from which it acts [ns]", commandSignals()),
      message("plan_report",
              "What happened in one solve of the planner. How long it took is a fact of the\n"
              "machine and is not in the log.",
              "simulated time of the state the plan starts from [ns]", planSignals()),
      message("sensor_frame",
              "Plant or drives -> controller: measured, never true, values. Joint order\n"
              "everywhere: wheels, then arm joints. Frames: W world, z up; B robot base, x\n"
              "forward.",
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
      "signals;\n"
      "// and how many of its fields have a size that depends on the robot.\n\n"
      "template <typename Message>\n"
      "struct FieldSizes;\n";
  for (const Message& m : messages()) {
    text += fmt::format(
        "\ntemplate <typename Visitor>\nvoid visitFields(ballbot_msgs::{}& m, Visitor&& visit) "
        "{{\n",
        m.name);
    for (std::size_t i = static_cast<std::size_t>(m.first); i < m.fields.size(); ++i) {
      const std::string& name = m.fields[i].name;
      text += "  visit(m." + name.substr(0, name.find('[')) + ");\n";
    }
    text += "}\n";
    text += fmt::format("template <>\nstruct FieldSizes<ballbot_msgs::{}> {{\n", m.name);
    const int joints = sizesBy(kJoints, m.fields), coordinates = sizesBy(kCoordinates, m.fields);
    text += fmt::format("  static constexpr int kPerJoint = {}, kPerCoordinate = {};\n", joints,
                        coordinates);
    text +=
        "  template <typename M>\n  static void setCounts(M&& m, int joints, int coordinates) {\n";
    text += joints > 0 ? "    m.joints = joints;\n" : "    (void)joints;\n";
    text += coordinates > 0 ? "    m.coordinates = coordinates;\n" : "    (void)coordinates;\n";
    if (joints + coordinates == 0) text += "    (void)m;\n";
    text += "  }\n};\n";
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
