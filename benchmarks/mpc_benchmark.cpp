#include <chrono>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <benchmark/benchmark.h>

#include "controller/mpc_planner.hpp"
#include "controller/whole_body_problem.hpp"
#include "core/config_reader.hpp"
#include "core/yaml_file.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

RobotParameters benchmarkRobot() {
  const ConfigNode tree = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/robots/ballbot.yaml");
  ConfigReader in(tree, "robot");
  return readRobot(in);
}

std::int64_t steadyClock() noexcept {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

/// Full robot, 19 states, 9 inputs; every task and barrier on, contact force included.
MpcConfig everythingOn(const RobotParameters& robot, double length, int stages, int threads) {
  MpcConfig c(robot);
  c.horizon.length = length;
  c.horizon.coarse_step = length / stages;
  c.threads = threads;
  c.contact_forces = true;
  c.clock = steadyClock;
  TaskSchedule s(robot);
  const auto three = [](double w) { return TimedWeight<3>(Vector3::Constant(w)); };
  const auto two = [](double w) { return TimedWeight<2>(Eigen::Vector2d::Constant(w)); };
  const auto one = [](double w) { return TimedWeight<1>(Eigen::Matrix<double, 1, 1>(w)); };
  s.ee_position_weight = three(400);
  s.ee_orientation_weight = three(20);
  s.ee_velocity_weight = three(4);
  s.ee_rate_weight = three(0.5);
  s.ball_position_weight = two(10);
  s.ball_velocity_weight = two(1);
  s.yaw_weight = one(20);
  s.base_rate_weight = three(4);
  s.arm_position_weight = three(0.1);
  s.arm_rate_weight = three(0.2);
  s.wheel_torque_weight = one(2);
  s.arm_torque_weight = one(0.05);
  s.contact_force_weight = three(1);
  s.contact_force = TimeSignal<3>(Vector3(0, 0, 5));
  c.schedule = std::make_shared<TaskSchedule>(s);
  return c;
}

/// A real-time iteration as a run does it: the last plan read at new knots, rolled out from a new
/// state while dynamics and cost are approximated, Riccati sweep, line search, new plan.
/// @param held  by the floor against a spin of the ball; kUnlimited without end [N m]
/// @param friction  of the wheels on the ball
void mpcIteration(benchmark::State& state, MpcConfig::Engine kind, double length, int stages,
                  int threads, double held, double friction) {
  RobotParameters robot = benchmarkRobot();
  robot.wheels.friction = friction;
  MpcConfig config = everythingOn(robot, length, stages, threads);
  config.engine = kind;
  const std::unique_ptr<MpcEngine> engine = makeEngine(robot, config);
  PlanConditions conditions;
  conditions.floor_held = held;
  engine->setConditions(conditions);
  const ReducedDynamics dynamics(robot);
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  MpcState x0;
  x0 << rest.x, Vector3::Zero();
  MpcPolicy seed = engine->emptyPolicy(), plan = seed, next = seed;
  const LqrSolution lqr = designLqr(dynamics, robot.nominal_arm, LqrWeights{});
  for (auto& knot : seed.knots()) knot.x = x0;
  for (auto& control : seed.controls()) {
    control.u << rest.tau, ContactInput::Zero();
    control.K.topLeftCorner<kJointCount, kStateDim>() = lqr.K;
  }
  seed.setValid(kSimStart);
  if (!engine->solve(kSimStart, x0, seed, 30, plan).ok()) state.SkipWithError("no first plan");
  // The measurement 14 ms later, a little off the plan, so that the iteration has work to do.
  const SimTime now = simTimeFromNs(14'000'000);
  MpcState x = plan.stateAt(0.014);
  x[kPitch] += 0.01;
  x[kBallX] += 0.005;
  x[kPositionDim + kBallVy] += 0.02;
  std::int64_t approximation = 0, riccati = 0, search = 0;
  for (auto _ : state) {
    const MpcSolveReport report = engine->solve(now, x, plan, 1, next);
    benchmark::DoNotOptimize(next);
    if (!report.ok() || report.step_length == 0) state.SkipWithError("no step taken");
    approximation += report.times.approximation_ns;
    riccati += report.times.riccati_ns;
    search += report.times.line_search_ns;
  }
  const auto microseconds = [](std::int64_t ns) {
    return benchmark::Counter(1e-3 * static_cast<double>(ns), benchmark::Counter::kAvgIterations);
  };
  state.counters["approximation_us"] = microseconds(approximation);
  state.counters["riccati_us"] = microseconds(riccati);
  state.counters["line_search_us"] = microseconds(search);
}

void registerIteration(std::string name, MpcConfig::Engine kind, double length, int stages,
                       int threads, double held = kUnlimited, double friction = kUnlimited) {
  if (threads == 2) name += "/threads:2";
  benchmark::RegisterBenchmark(name.c_str(), mpcIteration, kind, length, stages, threads, held,
                               friction)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

bool registerIterations() {
  for (const int threads : {1, 2}) {
    const auto kind = MpcConfig::Engine::kDiscrete;
    registerIteration("mpc_iteration/T1_N50", kind, 1, 50, threads);
    registerIteration("mpc_iteration/T1_N100", kind, 1, 100, threads);
    registerIteration("mpc_iteration/T2_N200", kind, 2, 200, threads);
  }
  registerIteration("mpc_iteration_floor_limited/T1_N50", MpcConfig::Engine::kDiscrete, 1, 50, 1,
                    0.4);
  registerIteration("mpc_iteration_traction_limited/T1_N50", MpcConfig::Engine::kDiscrete, 1, 50, 1,
                    0.4, 0.8);
  registerIteration("mpc_iteration_continuous/T1_N50", MpcConfig::Engine::kContinuous, 1, 50, 1);
  return true;
}
const bool registered = registerIterations();

/// A trajectory of 100 stages near rest, and what the solver's steps work on.
struct Stages {
  static constexpr int kCount = 100;
  using Problem = WholeBodyProblem<9>;

  explicit Stages(const RobotParameters& robot)
      : config(everythingOn(robot, 1, kCount, 1)),
        problem(robot, config.constraints, config.shaping, config.terminal, config.horizon.knots()),
        x(kCount),
        u(kCount),
        terms(kCount),
        lq(kCount) {
    problem.setTasks(*config.schedule, 0);
    const Equilibrium rest = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm);
    for (int k = 0; k < kCount; ++k) {
      x[k] << rest.x, Vector3::Constant(0.1);
      x[k][kPitch] += 1e-3 * k;
      u[k] << rest.tau, Vector3(0, 0, 5);
    }
  }
  void approximate() {
    problem.approximate(0, kCount, x.data(), u.data(), terms.data(), lq.data());
  }

  MpcConfig config;
  Problem problem;
  std::vector<Problem::X> x;
  std::vector<Problem::U> u;
  std::vector<CostTerms> terms;
  std::vector<Problem::Stage> lq;
};

/// Dynamics and cost with all derivatives, 100 stages.
void lq_approximation(benchmark::State& state) {
  Stages stages(benchmarkRobot());
  for (auto _ : state) {
    stages.approximate();
    benchmark::DoNotOptimize(stages.lq.data());
  }
}
BENCHMARK(lq_approximation)->Unit(benchmark::kMillisecond);

/// The solver's own Riccati recursion, 100 stages of 19 states and 9 inputs.
void riccati_sweep(benchmark::State& state) {
  Stages stages(benchmarkRobot());
  stages.approximate();
  ValueFunction<kMpcStateDim> final_value;
  CostTerms terms;
  stages.problem.approximateFinalCost(stages.x.back(), terms, final_value);
  std::vector<StageGain<kMpcStateDim, 9>> gain(Stages::kCount);
  for (auto _ : state) {
    ValueFunction<kMpcStateDim> value = final_value;
    bool positive = true;
    for (int k = Stages::kCount - 1; k >= 0; --k) {
      positive = riccatiStep(stages.lq[k], 1e-6, value, gain[k]) && positive;
    }
    if (!positive) state.SkipWithError("not convex");
    benchmark::DoNotOptimize(gain.data());
  }
}
BENCHMARK(riccati_sweep)->Unit(benchmark::kMillisecond);

/// The machine's yardstick: a discrete Riccati sweep in plain fixed-size Eigen, 100 stages of 19
/// states and 6 inputs, written as in a textbook.
void reference_riccati(benchmark::State& state) {
  constexpr int NX = 19, NU = 6, kStages = 100;
  using MatrixX = Eigen::Matrix<double, NX, NX>;
  using MatrixU = Eigen::Matrix<double, NU, NU>;
  using VectorX = Eigen::Matrix<double, NX, 1>;
  using VectorU = Eigen::Matrix<double, NU, 1>;
  using MatrixXU = Eigen::Matrix<double, NX, NU>;
  using MatrixUX = Eigen::Matrix<double, NU, NX>;
  struct Stage {
    MatrixX A, Q;
    MatrixXU B;
    MatrixUX P, K;
    MatrixU R;
    VectorX q;
    VectorU r, k;
  };
  std::srand(1);
  std::vector<Stage> stages(kStages);
  for (Stage& s : stages) {
    s.A = MatrixX::Identity() + 0.02 * MatrixX::Random();
    s.B = 0.02 * MatrixXU::Random();
    s.Q.setIdentity();
    s.R.setIdentity();
    s.P.setZero();
    s.q.setRandom();
    s.r.setRandom();
  }
  for (auto _ : state) {
    MatrixX S = MatrixX::Identity();
    VectorX v = VectorX::Zero();
    for (int k = kStages - 1; k >= 0; --k) {
      Stage& s = stages[k];
      const MatrixX SA = S * s.A;
      const MatrixXU SB = S * s.B;
      const MatrixU H = s.R + s.B.transpose() * SB;
      const MatrixUX G = s.P + s.B.transpose() * SA;
      const VectorU g = s.r + s.B.transpose() * v;
      const Eigen::LLT<MatrixU> llt(H);
      s.K = -llt.solve(G);
      s.k = -llt.solve(g);
      const MatrixX next = s.Q + s.A.transpose() * SA + G.transpose() * s.K;
      v = s.q + s.A.transpose() * v + G.transpose() * s.k;
      S = 0.5 * (next + next.transpose());
    }
    benchmark::DoNotOptimize(S);
    benchmark::DoNotOptimize(stages.data());
  }
}
BENCHMARK(reference_riccati)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ballbot
