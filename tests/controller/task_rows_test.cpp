// The cost's kernel against its list of tasks, row by row: value, gradient and Gauss-Newton Hessian
// of 1/2 sum w e^2, with the residuals as docs/theory/mpc.md has them, differentiated numerically.
#include <functional>
#include <map>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "controller/whole_body_cost.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using Input = Eigen::Matrix<double, kJointCount + kContactDim, 1>;

/// Everything a residual may depend on: state, then torques, force and moment in C.
constexpr int kPointDim = kStateDim + kJointCount + kContactDim;
using Point = Eigen::Matrix<double, kPointDim, 1>;
using Residual = std::function<Eigen::VectorXd(const Point&)>;

struct Rows {
  explicit Rows(const RobotParameters& robot) : dynamics(robot) {}

  Residual residualOf(const std::string& name, const Tasks& t) const {
    const auto tip = [this](const Point& p) { return dynamics.endEffector(p.head<kStateDim>()); };
    constexpr int kNu = kPositionDim, kU = kStateDim;
    const std::map<std::string, Residual> all = {
        {"ee_position", [=](const Point& p) -> Eigen::VectorXd { return tip(p).p_WE - t.p_WE; }},
        {"ee_orientation",
         [=](const Point& p) -> Eigen::VectorXd {
           return orientationError(t.R_WE, tip(p).R_WE).e;
         }},
        {"ee_velocity",
         [=](const Point& p) -> Eigen::VectorXd { return tip(p).v_WE_W - t.v_WE_W; }},
        {"ee_rate", [=](const Point& p) -> Eigen::VectorXd { return tip(p).w_WE_W - t.w_WE_W; }},
        {"ball_position",
         [=](const Point& p) -> Eigen::VectorXd { return p.segment<2>(kBallX) - t.ball_position; }},
        {"yaw",
         [=](const Point& p) -> Eigen::VectorXd { return p.segment<1>(kYaw).array() - t.yaw; }},
        {"ball_velocity",
         [=](const Point& p) -> Eigen::VectorXd {
           return p.segment<2>(kNu + kBallVx) - t.ball_velocity;
         }},
        {"base_rate",
         [=](const Point& p) -> Eigen::VectorXd { return p.segment<3>(kNu + kOmegaX); }},
        {"arm_position",
         [=](const Point& p) -> Eigen::VectorXd { return p.segment<3>(kArm1) - t.arm_position; }},
        {"arm_rate",
         [=](const Point& p) -> Eigen::VectorXd { return p.segment<3>(kNu + kArmRate1); }},
        // Shaped, and so no part of this kernel: the problems' tests have it.
        {"wheel_torque", [=](const Point&) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(3); }},
        {"arm_torque",
         [=](const Point& p) -> Eigen::VectorXd { return p.segment<3>(kU + kWheelCount); }},
        {"contact_force",
         [=](const Point& p) -> Eigen::VectorXd {
           return p.segment<3>(kU + kJointCount) - t.contact_force_C;
         }},
        {"contact_moment",
         [=](const Point& p) -> Eigen::VectorXd { return p.tail<3>() - t.contact_moment_C; }}};
    return all.at(name);
  }
  ReducedDynamics dynamics;
};

struct Expected {
  double value = 0;
  Point gradient = Point::Zero();
  Eigen::Matrix<double, kPointDim, kPointDim> hessian =
      Eigen::Matrix<double, kPointDim, kPointDim>::Zero();

  void add(const Residual& residual, const Eigen::VectorXd& weight, const Point& at) {
    const Eigen::VectorXd e = residual(at);
    Eigen::MatrixXd J(e.size(), kPointDim);
    constexpr double h = 1e-6;
    for (int i = 0; i < kPointDim; ++i) {
      const Point step = h * Point::Unit(i);
      J.col(i) = (residual(at + step) - residual(at - step)) / (2 * h);
    }
    value += 0.5 * weight.dot(e.cwiseAbs2());
    gradient += J.transpose() * weight.cwiseProduct(e);
    hessian += J.transpose() * weight.asDiagonal() * J;
  }
};

/// What the kernel makes of the same point.
struct Kernel {
  Kernel(const WholeBodyCost& cost, const Tasks& tasks, const Point& at) {
    constexpr int kStride = roundUpTo4(kStateDim + 1);
    alignas(32) double W[kStride * kStride] = {};
    cost.expandState(at.head<kStateDim>(), tasks, 1, terms, {W, kStride, kStateDim});
    InputExpansion input;
    cost.expandInput(at.segment<kJointCount>(kStateDim), at.tail<kContactDim>(), tasks, 1, terms,
                     input);
    for (int c = 0; c < kStateDim; ++c) {
      gradient[c] = W[c * kStride + kStateDim];
      for (int r = c; r < kStateDim; ++r) hessian(r, c) = hessian(c, r) = W[c * kStride + r];
    }
    gradient.tail(kPointDim - kStateDim) = input.gradient;
    hessian.diagonal().tail(kPointDim - kStateDim) = input.diagonal;
    hessian.block<3, 3>(kStateDim + kJointCount, kStateDim + kJointCount) = input.force_hessian;
  }
  CostTerms terms;
  Point gradient = Point::Zero();
  Eigen::Matrix<double, kPointDim, kPointDim> hessian =
      Eigen::Matrix<double, kPointDim, kPointDim>::Zero();
};

/// Without barriers: their weights are zero.
Constraints noLimits(const RobotParameters& robot) {
  Constraints c(robot);
  c.torque.mu = c.cone.mu = c.arm_position.mu = c.arm_rate.mu = c.wheel_rate.mu = c.tilt.mu = 0;
  return c;
}

void setWeight(double& weight, double w) { weight = w; }
template <int N>
void setWeight(Eigen::Matrix<double, N, 1>& weight, double w) {
  weight = w * Eigen::Matrix<double, N, 1>::LinSpaced(1, N);
}
Eigen::VectorXd weightsOf(double weight, int size) {
  return Eigen::VectorXd::Constant(size, weight);
}
template <int N>
Eigen::VectorXd weightsOf(const Eigen::Matrix<double, N, 1>& weight, int) {
  return weight;
}

Tasks someTasks() {
  Tasks t;
  t.p_WE << 0.3, -0.2, 0.9;
  t.R_WE = Eigen::AngleAxisd(0.4, Vector3(0.2, -0.5, 0.8).normalized());
  t.v_WE_W << 0.1, 0.2, -0.3;
  t.w_WE_W << -0.2, 0.1, 0.4;
  t.ball_position << 0.2, -0.1;
  t.ball_velocity << 0.3, 0.1;
  t.yaw = 0.3;
  t.arm_position << 0.1, -0.4, 1.2;
  t.contact_force_C << 0.5, -0.3, 6;
  t.contact_moment_C << 0.1, 0.2, -0.1;
  return t;
}

Point somePoint() {
  Point p;
  for (int i = 0; i < kPointDim; ++i) p[i] = 0.4 * std::sin(1 + 2.3 * i);
  p[kPitch] *= 0.5;
  return p;
}

void expectRow(const std::string& name, Tasks tasks, const std::function<void(Tasks&)>& weigh,
               const std::function<Eigen::VectorXd(const Tasks&, int)>& weights, CostTerm term) {
  const RobotParameters robot = exampleRobot();
  const Rows rows(robot);
  const WholeBodyCost cost(robot, noLimits(robot));
  const Point at = somePoint();
  // A plan is without contact, and its force at zero, unless a force is asked for.
  const Kernel without(cost, tasks, at);
  weigh(tasks);
  const Kernel with(cost, tasks, at);
  const Residual residual = rows.residualOf(name, tasks);
  Expected expected;
  expected.add(residual, weights(tasks, static_cast<int>(residual(at).size())), at);
  const bool force = name == "contact_force", moment = name == "contact_moment";
  // Unless they are asked for, force and moment are kept at zero: that is no part of any row.
  Point gradient = with.gradient - without.gradient;
  auto hessian = with.hessian;
  hessian -= without.hessian;
  const int first = kStateDim + kJointCount + (moment ? 3 : 0);
  if (force || moment) {
    gradient.segment<3>(first) = with.gradient.segment<3>(first);
    hessian.block<3, 3>(first, first) = with.hessian.block<3, 3>(first, first);
  }
  const double value = with.terms.value[term] - (force || moment ? 0 : without.terms.value[term]);
  if (name == "wheel_torque") {
    EXPECT_EQ(value, 0);
    return;
  }
  EXPECT_GT(expected.value, 1e-4) << name << ": nothing to compare";
  EXPECT_NEAR(value, expected.value, 1e-12 * (1 + expected.value)) << name;
  EXPECT_LT((gradient - expected.gradient).norm(), 1e-7 * (1 + expected.gradient.norm())) << name;
  EXPECT_LT((hessian - expected.hessian).norm(), 1e-7 * (1 + expected.hessian.norm())) << name;
}

TEST(TaskRows, TheKernelIsTheSumOfItsRows) {
#define BALLBOT_ROW(name, N, unit, term, least, words)                                    \
  {                                                                                       \
    Tasks tasks = someTasks();                                                            \
    /* moments are asked for in a contact only */                                         \
    if (std::string(#name) == "contact_moment") setWeight(tasks.contact_force_weight, 2); \
    expectRow(                                                                            \
        #name, tasks, [](Tasks& t) { setWeight(t.name##_weight, 3); },                    \
        [](const Tasks& t, int size) { return weightsOf(t.name##_weight, size); }, term); \
  }
  BALLBOT_TASKS(BALLBOT_ROW, BALLBOT_ROW)
#undef BALLBOT_ROW
}

}  // namespace
}  // namespace ballbot
