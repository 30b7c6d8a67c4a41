// SUNDIALS before everything of the plant: Simbody's library has symbols of an old CVODE in it.
#include "plant/integrator.hpp"

#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "plant/plant_dynamics.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

class Oscillator final : public OdeSystem {
 public:
  void derivative(double t, const double* y, double* ydot) override {
    ydot[0] = y[1];
    ydot[1] = -y[0] + std::cos(2 * t);
  }
};

TEST(RungeKutta4, IsOfFourthOrder) {
  // y'' + y = cos 2t from rest: y = (cos t - cos 2t) / 3.
  const auto errorWith = [](int steps) {
    Oscillator system;
    RungeKutta4 rk4(2);
    double y[2] = {0, 0};
    for (int i = 0; i < steps; ++i) rk4.step(system, 2.0 * i / steps, 2.0 / steps, y);
    return std::hypot(y[0] - (std::cos(2.0) - std::cos(4.0)) / 3,
                      y[1] - (2 * std::sin(4.0) - std::sin(2.0)) / 3);
  };
  EXPECT_NEAR(errorWith(50) / errorWith(100), 16, 1);
}

int cvodeDerivative(realtype t, N_Vector y, N_Vector ydot, void* system) {
  static_cast<OdeSystem*>(system)->derivative(t, N_VGetArrayPointer(y), N_VGetArrayPointer(ydot));
  return 0;
}

/// Integrates with CVODE (Adams, error control) from 0 to `end`.
std::vector<double> byCvode(OdeSystem& system, std::vector<double> y, double end) {
  SUNContext context = nullptr;
  EXPECT_EQ(SUNContext_Create(nullptr, &context), 0);
  N_Vector state = N_VMake_Serial(static_cast<sunindextype>(y.size()), y.data(), context);
  void* cvode = CVodeCreate(CV_ADAMS, context);
  EXPECT_EQ(CVodeInit(cvode, cvodeDerivative, 0, state), CV_SUCCESS);
  EXPECT_EQ(CVodeSStolerances(cvode, 1e-10, 1e-10), CV_SUCCESS);
  EXPECT_EQ(CVodeSetUserData(cvode, &system), CV_SUCCESS);
  EXPECT_EQ(CVodeSetMaxNumSteps(cvode, 1000000), CV_SUCCESS);
  EXPECT_EQ(CVodeSetStopTime(cvode, end), CV_SUCCESS);
  SUNNonlinearSolver fixed_point = SUNNonlinSol_FixedPoint(state, 0, context);
  EXPECT_EQ(CVodeSetNonlinearSolver(cvode, fixed_point), CV_SUCCESS);
  double t = 0;
  EXPECT_GE(CVode(cvode, end, state, &t, CV_NORMAL), CV_SUCCESS);
  EXPECT_EQ(t, end);
  CVodeFree(&cvode);
  SUNNonlinSolFree(fixed_point);
  N_VDestroy(state);
  SUNContext_Free(&context);
  return y;
}

/// The full plant on its way between two ticks of very slow drives.
class PlantTrajectory : public ::testing::TestWithParam<const char*> {
 protected:
  static constexpr double kEnd = 0.1;

  PlantTrajectory()
      : config(plantConfig("full", {"plant.fidelity.multibody=" + std::string(GetParam()),
                                    "plant.fidelity.contact=rolling_with_spin_friction"})),
        dynamics(config) {
    RobotPose pose;
    pose.pitch = 0.1;
    pose.roll = -0.05;
    pose.arm = config.robot.nominal_arm;
    start.assign(dynamics.dim(), 0.0);
    dynamics.multibody().place(pose, start.data());
    VelocityVector nu;
    nu << 0.3, -0.2, 0.3, -0.2, 0.8, 0.5, -0.4, 0.6;
    dynamics.multibody().setVelocity(nu, 0.2, start.data());
    JointVector torque;
    torque << 1, -0.5, 0.3, 0.5, -6, 3;
    dynamics.demand(torque, 0);
    dynamics.forces().push_back({kBaseBody, Vector3(0, 0, 0.35), Vector3(0, 20, 0)});
  }

  std::vector<double> byRungeKutta(int steps) {
    std::vector<double> y = start;
    RungeKutta4 rk4(dynamics.dim());
    for (int i = 0; i < steps; ++i) {
      rk4.step(dynamics, kEnd * i / steps, kEnd / steps, y.data());
      dynamics.project(y.data());
    }
    return y;
  }

  PlantConfig config;
  PlantDynamics dynamics;
  std::vector<double> start;
};

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::abs(a[i] - b[i]) / (1 + std::abs(b[i])));
  }
  return worst;
}

TEST_P(PlantTrajectory, IsThatOfCvode) {
  const std::vector<double> reference = byCvode(dynamics, start, kEnd);
  const double at_production_step = distance(byRungeKutta(250), reference);  // 0.4 ms
  const double at_half = distance(byRungeKutta(500), reference);
  EXPECT_LT(at_production_step, 5e-5);
  EXPECT_GT(at_production_step / at_half, 8);  // converging to the same solution
  EXPECT_LT(distance(byRungeKutta(2000), reference), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Structures, PlantTrajectory, ::testing::Values("full", "reduced_wheels"),
                         [](const auto& structure) { return std::string(structure.param); });

}  // namespace
}  // namespace ballbot
