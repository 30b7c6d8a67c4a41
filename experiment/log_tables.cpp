#include "experiment/log_tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "controller/cost_terms.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"

namespace ballbot {
namespace {

constexpr const char* kJoints[] = {"wheel1", "wheel2", "wheel3", "arm1", "arm2", "arm3"};
constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr std::pair<const char*, const char*> kPositions[] = {
    {"px", "m"}, {"py", "m"}, {"yaw", "rad"}, {"pitch", "rad"}, {"roll", "rad"},
    {"arm1", "rad"}, {"arm2", "rad"}, {"arm3", "rad"}};
constexpr std::pair<const char*, const char*> kVelocities[] = {
    {"vx", "m/s"}, {"vy", "m/s"}, {"omega_x", "rad/s"}, {"omega_y", "rad/s"}, {"omega_z", "rad/s"},
    {"arm1_rate", "rad/s"}, {"arm2_rate", "rad/s"}, {"arm3_rate", "rad/s"}};

/// Builds a table column by column from a list of messages.
template <typename Message>
class TableBuilder {
 public:
  TableBuilder(std::string name, const std::vector<Message>& messages) : messages_(messages) {
    table_.name = std::move(name);
    add("time_s", "s", [](const Message& m) { return decimalSeconds(m.sim_time_ns); });
  }
  template <typename Get>
  TableBuilder& add(const std::string& name, const char* unit, Get get) {
    LogTable::Column column{name, unit, {}};
    column.values.reserve(messages_.size());
    for (const Message& m : messages_) column.values.push_back(static_cast<double>(get(m)));
    table_.columns.push_back(std::move(column));
    return *this;
  }
  template <typename Get>
  TableBuilder& addJoints(const std::string& name, const char* unit, Get get) {
    for (int j = 0; j < 6; ++j) add(name + "_" + kJoints[j], unit, [&](const Message& m) { return get(m)[j]; });
    return *this;
  }
  template <typename Get>
  TableBuilder& addVector(const std::string& name, const char* unit, Get get) {
    for (int i = 0; i < 3; ++i) add(name + "_" + kAxes[i], unit, [&](const Message& m) { return get(m)[i]; });
    return *this;
  }
  TableBuilder& addCostTerms() {
    for (int i = 0; i < kCostTermCount; ++i) {
      add(costColumn(CostTerm(i)), "", [i](const Message& m) { return m.cost_terms[i]; });
    }
    return *this;
  }
  template <typename GetQ, typename GetNu>
  TableBuilder& addState(GetQ q, GetNu nu) {
    for (int i = 0; i < 8; ++i) add(kPositions[i].first, kPositions[i].second, [&](const Message& m) { return q(m)[i]; });
    for (int i = 0; i < 8; ++i) add(kVelocities[i].first, kVelocities[i].second, [&](const Message& m) { return nu(m)[i]; });
    return *this;
  }
  void into(std::vector<LogTable>& tables) {
    if (!messages_.empty()) tables.push_back(std::move(table_));
  }

 private:
  const std::vector<Message>& messages_;
  LogTable table_;
};

}  // namespace

const std::vector<double>& LogTable::column(const std::string& column_name) const {
  for (const Column& c : columns) {
    if (c.name == column_name) return c.values;
  }
  throw InputError(fmt::format("table '{}' has no column '{}'", name, column_name));
}

std::string costColumn(CostTerm term) { return std::string("cost_") + costTermName(term); }

std::vector<LogTable> logTables(const RunLog& log) {
  using namespace ballbot_msgs;
  std::vector<LogTable> tables;
  TableBuilder<sensor_frame>("sensors", log.sensors)
      .addJoints("motor_angle", "rad", [](const sensor_frame& m) { return m.motor_angle; })
      .addJoints("joint_angle", "rad", [](const sensor_frame& m) { return m.joint_angle; })
      .addJoints("joint_velocity", "rad/s", [](const sensor_frame& m) { return m.joint_velocity; })
      .addJoints("joint_torque", "N m", [](const sensor_frame& m) { return m.joint_torque; })
      .add("imu_count", "", [](const sensor_frame& m) { return m.imu_count; })
      .add("imu_time", "s", [](const sensor_frame& m) { return decimalSeconds(m.imu_time_ns); })
      .addVector("accel_B", "m/s^2", [](const sensor_frame& m) { return m.accel_B; })
      .addVector("gyro_WB_B", "rad/s", [](const sensor_frame& m) { return m.gyro_WB_B; })
      .add("pose_count", "", [](const sensor_frame& m) { return m.pose_count; })
      .add("pose_time", "s", [](const sensor_frame& m) { return decimalSeconds(m.pose_time_ns); })
      .add("pose_x", "m", [](const sensor_frame& m) { return m.pose_W[0]; })
      .add("pose_y", "m", [](const sensor_frame& m) { return m.pose_W[1]; })
      .add("pose_yaw", "rad", [](const sensor_frame& m) { return m.pose_W[2]; })
      .into(tables);
  TableBuilder<truth_frame>("truth", log.truth)
      .addState([](const truth_frame& m) { return m.q; }, [](const truth_frame& m) { return m.nu; })
      .addJoints("joint_angle", "rad", [](const truth_frame& m) { return m.joint_angle; })
      .addJoints("joint_velocity", "rad/s", [](const truth_frame& m) { return m.joint_velocity; })
      .addJoints("motor_angle", "rad", [](const truth_frame& m) { return m.motor_angle; })
      .addJoints("joint_torque", "N m", [](const truth_frame& m) { return m.joint_torque; })
      .addVector("p_WE", "m", [](const truth_frame& m) { return m.p_WE; })
      .add("quat_WE_w", "", [](const truth_frame& m) { return m.quat_WE[0]; })
      .add("quat_WE_x", "", [](const truth_frame& m) { return m.quat_WE[1]; })
      .add("quat_WE_y", "", [](const truth_frame& m) { return m.quat_WE[2]; })
      .add("quat_WE_z", "", [](const truth_frame& m) { return m.quat_WE[3]; })
      .addVector("external_force_W", "N", [](const truth_frame& m) { return m.external_force_W; })
      .addVector("contact_force_W", "N", [](const truth_frame& m) { return m.contact_force_W; })
      .addVector("contact_point_W", "m", [](const truth_frame& m) { return m.contact_point_W; })
      .add("contact_phase", "", [](const truth_frame& m) { return m.contact_phase; })
      .add("door_angle", "rad", [](const truth_frame& m) { return m.door_angle; })
      .add("door_rate", "rad/s", [](const truth_frame& m) { return m.door_rate; })
      .into(tables);
  TableBuilder<state_estimate>("estimate", log.estimates)
      .addState([](const state_estimate& m) { return m.q; }, [](const state_estimate& m) { return m.nu; })
      .add("sigma_px", "m", [](const state_estimate& m) { return m.sigma[0]; })
      .add("sigma_py", "m", [](const state_estimate& m) { return m.sigma[1]; })
      .add("sigma_tilt_1", "rad", [](const state_estimate& m) { return m.sigma[2]; })
      .add("sigma_tilt_2", "rad", [](const state_estimate& m) { return m.sigma[3]; })
      .add("sigma_yaw", "rad", [](const state_estimate& m) { return m.sigma[4]; })
      .add("sigma_vx", "m/s", [](const state_estimate& m) { return m.sigma[5]; })
      .add("sigma_vy", "m/s", [](const state_estimate& m) { return m.sigma[6]; })
      .addVector("sigma_omega", "rad/s", [](const state_estimate& m) { return m.sigma + 7; })
      .addVector("contact_force_W", "N", [](const state_estimate& m) { return m.contact_force_W; })
      .add("aligned", "", [](const state_estimate& m) { return m.aligned; })
      .into(tables);
  TableBuilder<actuator_command>("command", log.commands)
      .addJoints("torque", "N m", [](const actuator_command& m) { return m.torque; })
      .addJoints("position", "rad", [](const actuator_command& m) { return m.position; })
      .addJoints("velocity", "rad/s", [](const actuator_command& m) { return m.velocity; })
      .addJoints("stiffness", "N m/rad", [](const actuator_command& m) { return m.stiffness; })
      .addJoints("damping", "N m s/rad", [](const actuator_command& m) { return m.damping; })
      .into(tables);
  TableBuilder<plan_report>("plan", log.plans)
      .add("acts_from", "s", [](const plan_report& m) { return decimalSeconds(m.acts_from_ns); })
      .add("accepted", "", [](const plan_report& m) { return m.accepted; })
      .add("iterations", "", [](const plan_report& m) { return m.iterations; })
      .add("cost", "", [](const plan_report& m) { return m.cost; })
      .add("step_length", "", [](const plan_report& m) { return m.step_length; })
      .add("constraint_violation", "", [](const plan_report& m) { return m.constraint_violation; })
      .add("contact_state", "", [](const plan_report& m) { return m.contact_state; })
      .addVector("contact_asked_W", "N", [](const plan_report& m) { return m.contact_asked_W; })
      .addVector("contact_counted_on_W", "N",
                 [](const plan_report& m) { return m.contact_counted_on_W; })
      .add("status", "", [](const plan_report& m) { return m.status; })
      .add("fallback", "", [](const plan_report& m) { return m.fallback; })
      .add("predicted_decrease", "", [](const plan_report& m) { return m.predicted_decrease; })
      .add("regularisation", "", [](const plan_report& m) { return m.regularisation; })
      .addCostTerms()
      .into(tables);
  return tables;
}

const LogTable* findTable(const std::vector<LogTable>& tables, const std::string& name) {
  const auto it = std::find_if(tables.begin(), tables.end(), [&](const LogTable& t) { return t.name == name; });
  return it == tables.end() ? nullptr : &*it;
}

}  // namespace ballbot
