#include "experiment/live_scene.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/angle.hpp"
#include "experiment/contact_report.hpp"
#include "experiment/run_replay.hpp"
#include "experiment/text_file.hpp"
#include "metrics/balance_metrics.hpp"
#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"
#include "report/json_text.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

ReportReplay replayOf(const TruthFrame& truth, const RunConfig& config, const ReplayNames& names) {
  const PlantConfig& plant = config.plant.plant;
  const std::vector<Push>& pushes = plant.pushes;
  RunLog log;
  log.truth.push_back(truth);
  ReportReplay replay =
      makeReplay(log, config.robot, names, pushes, *config.reference(), config.home);
  replay.objects = replayObjects(log, plant.surroundings);
  if (replay.forces.size() == pushes.size()) {  // nothing touched just now
    replay.forces.push_back({"contact", ReportPhase::Kind::kContact, {{0, 0, 0}}, {{0, 0, 0}}});
  }
  return replay;
}

void append(Json& out, const ReplayPose& pose) {
  for (const double v : pose.p_W) out.push_back(v);
  for (const double v : pose.quat_W) out.push_back(v);
}

const char* nameOf(SeriesStyle style) {
  return style == SeriesStyle::kReference ? "reference" : "measured";
}

}  // namespace

LiveScene::LiveScene(const RunConfig& config) : config_(config), names_(ReplayNames::of(config)) {}

std::string LiveScene::description() const {
  const ReportReplay replay = replayOf({}, config_, names_);
  Json out = {{"title", config_.scenario.name},
              {"subtitle", config_.scenario.summary},
              {"duration", toSeconds(config_.scenario.duration)},
              {"urdf", readTextFile(config_.scenario.urdf_path)},
              {"followed_link", replay.followed_link}};
  for (const auto& body : replay.bodies) out["bodies"].push_back(body.link);
  for (const auto& joint : replay.joints) out["joints"].push_back(joint.name);
  for (const auto& frame : replay.frames) {
    out["frames"].push_back({{"name", frame.name}, {"style", nameOf(frame.style)}});
  }
  for (const auto& force : replay.forces) {
    out["forces"].push_back(
        {{"name", force.name},
         {"kind", force.kind == ReportPhase::Kind::kPush ? "push" : "contact"}});
  }
  out["objects"] = Json::array();
  for (const auto& object : replay.objects) {
    out["objects"].push_back({{"name", object.name}, {"size", object.box_size}});
  }
  out["plots"] = {{{"quantity", "ball position"}, {"unit", "m"}, {"series", {"x", "y"}}},
                  {{"quantity", "tilt"}, {"unit", "deg"}, {"series", {"tilt"}}},
                  {{"quantity", "force"}, {"unit", "N"}, {"series", {"pushes", "contact"}}}};
  return jsonText(out, -1);
}

std::string LiveScene::frame(const TruthFrame& truth) {
  const double t = toSeconds(truth.time);
  if (!started_ || t < last_s_) ball_.setIdentity();  // the first frame, or another run
  const double dt = started_ && t > last_s_ ? t - last_s_ : 0;
  started_ = true;
  last_s_ = t;
  const Vector3 w = OmniwheelKinematics::rollingAngularVelocity(truth.state[kPositionDim + kBallVx],
                                                                truth.state[kPositionDim + kBallVy],
                                                                config_.robot.ball.radius);
  ball_ = (Eigen::Quaterniond(expSO3(w * dt)) * ball_).normalized();

  ReportReplay replay = replayOf(truth, config_, names_);
  Json bodies = Json::array(), joints = Json::array(), frames = Json::array(),
       points = Json::array(), forces = Json::array(), objects = Json::array();
  for (auto& body : replay.bodies) {
    if (body.link == names_.ball) {
      body.poses.front().quat_W = {ball_.w(), ball_.x(), ball_.y(), ball_.z()};
    }
    append(bodies, body.poses.front());
  }
  for (const auto& joint : replay.joints) joints.push_back(joint.angle.front());
  for (const auto& frame : replay.frames) append(frames, frame.poses.front());
  for (const auto& force : replay.forces) {
    for (const double v : force.point_W.front()) points.push_back(v);
    for (const double v : force.force_W.front()) forces.push_back(v);
  }
  for (const auto& object : replay.objects) append(objects, object.poses.front());

  const Json values = {{truth.state[kBallX], truth.state[kBallY]},
                       {kDegPerRad * tiltAngle(truth.state)},
                       {truth.external_force_W.norm(), truth.contact_force_W.norm()}};
  return Json{{"t", t},           {"bodies", bodies}, {"joints", joints},   {"frames", frames},
              {"points", points}, {"forces", forces}, {"objects", objects}, {"values", values}}
      .dump();
}

}  // namespace ballbot
