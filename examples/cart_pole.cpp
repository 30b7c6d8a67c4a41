// Swings a pole up by pushing its cart: an optimal control problem, solved with solver/ alone.
#include <cmath>
#include <cstdio>

#include "solver/scalar_cost.hpp"
#include "solver/slq_solver_impl.hpp"

using namespace ballbot;
constexpr double h = 0.02, M = 1, m = 0.3, l = 0.5, g = 9.81;  // step [s], cart, pole [kg], rod [m]

/// State: position [m], angle from upright [rad], their rates. Input: force on the cart [N].
struct CartPole final : OptimalControlProblem<4, 1, ScalarCost> {
  const X weight = h * X(1, 1, 0.1, 0.1), final_weight = X(200, 500, 20, 20);
  int stages() const noexcept override { return 150; }
  void step(int, const X& x, const U& u, X& next) const noexcept override {  // semi-implicit Euler
    const double s = std::sin(x[1]), c = std::cos(x[1]);
    const double a = (u[0] + m * s * (l * x[3] * x[3] - g * c)) / (M + m * s * s);
    next.tail<2>() = x.tail<2>() + h * Eigen::Vector2d(a, (g * s - a * c) / l);
    next.head<2>() = x.head<2>() + h * next.tail<2>();
  }
  void addCost(int, const X& x, const U& u, ScalarCost& cost) const noexcept override {
    cost.add(0.5 * weight.dot(x.cwiseAbs2()) + 0.5 * h * 0.05 * u[0] * u[0]);
  }
  void addFinalCost(const X& x, ScalarCost& cost) const noexcept override {
    cost.add(0.5 * final_weight.dot(x.cwiseAbs2()));
  }
  void approximate(int first, int count, const X* x, const U* u, ScalarCost* cost,
                   LqStage<4, 1>* lq) const noexcept override {
    for (int i = 0; i < count; ++i) {
      addCost(first + i, x[i], u[i], cost[i]);
      const double s = std::sin(x[i][1]), c = std::cos(x[i][1]), w = x[i][3], D = M + m * s * s;
      const double a = (u[i][0] + m * s * (l * w * w - g * c)) / D, a_w = 2 * m * s * l * w / D;
      const double a_th = m * (c * (l * w * w - g * c) + g * s * s - 2 * a * s * c) / D;
      Eigen::Matrix<double, 2, 4> rates;  // derivatives of the accelerations
      rates << 0, a_th, 0, a_w, 0, ((g - a_th) * c + a * s) / l, 0, -a_w * c / l;
      lq[i].A().setIdentity().bottomRows<2>() += h * rates;
      lq[i].A().topRows<2>() += h * lq[i].A().bottomRows<2>();
      lq[i].B() << h * h / D, -h * h * c / (D * l), h / D, -h * c / (D * l);
      lq[i].Q() = weight.asDiagonal(), lq[i].q() = weight.cwiseProduct(x[i]);
      lq[i].R()(0) = h * 0.05, lq[i].r() = h * 0.05 * u[i];
    }
  }
  void approximateFinalCost(const X& x, ScalarCost& L,
                            ValueFunction<4>& V) const noexcept override {
    addFinalCost(x, L);
    V.set(final_weight.asDiagonal(), final_weight.cwiseProduct(x), 0);
  }
};

int main() {
  const CartPole problem;
  SlqSolver<4, 1, ScalarCost> solver(problem.stages(), SlqOptions{});
  for (auto& x : solver.nominal().x) x << 0, M_PI, 0, 0;  // the guess: hang; pushes begin as zero
  const auto report = solver.converge(problem, CartPole::X(0, M_PI, 0, 0), 300, 1e-8);
  std::printf("%s\n  time  position   angle\n", slqStatusName(report.status));
  const auto& x = solver.solution().x;
  for (int k = 0; k <= problem.stages(); k += 10)
    std::printf("%4.1f s%8.3f m%6.1f deg\n", k * h, x[k][0], x[k][1] * 180 / M_PI);
  return report.ok() && std::abs(x.back()[1]) < 0.05 ? 0 : 1;
}
