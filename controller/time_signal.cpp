#include "controller/time_signal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "model/state.hpp"

namespace ballbot {
namespace {

constexpr double kLongest_s = 1e6;

/// What readVector() reads.
template <int N>
constexpr const char* vectorKind() {
  return N == 1   ? "number, or a list of one"
         : N == 2 ? "number for both components, or a list of 2"
                  : "number for all components, or a list of 3";
}

}  // namespace

template <int N>
typename TimeSignal<N>::Vector TimeSignal<N>::value(double t, double now) const {
  Vector out = initial_;
  for (const Move& m : moves_) {
    const bool is_step = m.over == 0;
    if ((is_step ? now : t) < m.at) continue;
    if (m.radius == 0) {
      const double share = m.over > 0 ? std::min(1.0, (t - m.at) / m.over) : 1.0;
      out += share * m.by;
    } else if constexpr (N >= 2) {
      const double angle = kTwoPi * std::min(t - m.at, m.over) / m.period;
      out[0] += m.radius * (std::cos(angle) - 1);
      out[1] += m.radius * std::sin(angle);
    }
  }
  return out;
}

template <int N>
typename TimeSignal<N>::Vector TimeSignal<N>::rate(double t) const {
  Vector out = Vector::Zero();
  for (const Move& m : moves_) {
    if (t < m.at || t >= m.at + m.over) continue;
    if (m.radius == 0) {
      out += m.by / m.over;
    } else if constexpr (N >= 2) {
      const double omega = kTwoPi / m.period, angle = omega * (t - m.at);
      out[0] -= m.radius * omega * std::sin(angle);
      out[1] += m.radius * omega * std::cos(angle);
    }
  }
  return out;
}

template <int N>
std::vector<typename TimeSignal<N>::Step> TimeSignal<N>::steps() const {
  std::vector<Step> out;
  for (const Move& m : moves_) {
    if (m.over == 0) out.push_back({m.at, m.by});
  }
  return out;
}

template <int N>
std::vector<double> TimeSignal<N>::turningTimes() const {
  constexpr int kPerTurn = 64;
  std::vector<double> out = {0};
  for (const Move& m : moves_) {
    for (int i = 0; m.radius != 0 && i < kPerTurn; ++i) {
      out.push_back(m.at + std::min(m.over, i * m.period / kPerTurn));
    }
    out.push_back(m.at);
    out.push_back(m.at + m.over);
  }
  return out;
}

template <int N>
void TimeSignal<N>::circle(double at, double radius, double period, double turns) {
  static_assert(N >= 1);
  moves_.push_back({at, turns * period, Vector::Zero(), radius, period});
}

template <int N>
void TimeSignal<N>::describe(ConfigVisitor& v) {
  v.other(
      may("initial", "value before any move; by default that of the robot at rest at the origin"),
      vectorKind<N>(),
      [&](ConfigReader& in) { initial_ = readVector<N>(in, "initial", -1e6, 1e6); });
  v.list(may("moves", "steps, ramps and circles; they add up and may overlap"),
         [&](ConfigVisitor& move) { describeMove(move); });
}

template <int N>
void TimeSignal<N>::describeMove(ConfigVisitor& v) {
  double at = -1, over = 0, radius = 0, period = 0, turns = 1;
  std::optional<Vector> by;
  v.number(must("at_s", "time at which the move begins"), at, {0, kLongest_s});
  const bool was_read = at >= 0;
  // What belongs to the one kind of move is needed by it and unknown to the other. Where nothing
  // was read both are told, and neither is needed; but no circle where there is no plane for it.
  const bool tell_circle = N >= 2 || was_read;
  if (tell_circle) {
    v.other(may("circle_radius_m",
                "makes the move a circle in the first two components, leaving in the direction of "
                "the second; this is its radius"),
            "number, above 0, at most 100", [&](ConfigReader& in) {
              if (N < 2) {
                throw InputError(fmt::format("{} needs two components, this reference has {}",
                                             in.at("circle_radius_m"), N));
              }
              radius = in.number("circle_radius_m", {kTiny, 100});
            });
  }
  const bool is_circle = radius > 0;
  if (!is_circle) {
    v.other({"by", "how far a step or a ramp goes; needed unless the move is a circle", was_read},
            vectorKind<N>(), [&](ConfigReader& in) { by = readVector<N>(in, "by", -1e6, 1e6); });
    v.number(may("over_s", "time that a ramp takes; 0 makes it a step"), over, {0, kLongest_s});
  }
  if (tell_circle && !by) {
    v.other({"period_s", "time that one turn of a circle takes; needed by a circle", is_circle},
            "number, 0.1 to 1000000", [&](ConfigReader& in) {
              period = in.number("period_s", {0.1, kLongest_s});
            });
    v.number(may("turns", "how often a circle is gone round"), turns, {kTiny, 1e6});
  }
  if (is_circle) circle(at, radius, period, turns);
  if (by) ramp(at, over, *by);
}

template <int N>
Eigen::Matrix<double, N, 1> readVector(ConfigReader& in, const char* key, double low, double high) {
  const ConfigNode* node = in.raw(key);
  if (node && node->kind() == ConfigNode::Kind::kList) {
    const auto values = in.numbers<N>(key, {low, high});
    return Eigen::Map<const Eigen::Matrix<double, N, 1>>(values.data());
  }
  return Eigen::Matrix<double, N, 1>::Constant(in.number(key, {low, high}));
}

template <int N>
const typename TimedWeight<N>::Vector& TimedWeight<N>::value(double t, double now) const {
  std::size_t i = changes_.size() - 1;
  while (i > 0 && std::min(t, now) < changes_[i].at) --i;
  return changes_[i].weight;
}

template <int N>
void TimedWeight<N>::change(double at, const Vector& weight) {
  changes_.push_back({at, weight});
}

template <int N>
void TimedWeight<N>::describe(ConfigVisitor& v, double least) {
  const char* const words =
      least > 0 ? "weight of the square in the plan's cost, above 0; larger keeps it smaller"
                : "weight of the squared error in the plan's cost; larger holds it closer, 0 "
                  "leaves it free";
  v.other(must("weight", words), vectorKind<N>(),
          [&](ConfigReader& in) { *this = TimedWeight(readVector<N>(in, "weight", least, 1e9)); });
  double last = -kInf;
  v.list(
      may("weight_changes", "weights that hold from a time on, in order of time"),
      [&](ConfigVisitor& change_in) {
        double at = 0;
        change_in.number(must("at_s", "time from which on the weight holds"), at, {0, kLongest_s});
        change_in.other(
            must("weight", "weight from that time on"), vectorKind<N>(), [&](ConfigReader& in) {
              if (at <= last) {
                throw InputError(
                    fmt::format("{} is {}, must be later than the change before it, at {} s",
                                in.at("at_s"), at, last));
              }
              last = at;
              change(at, readVector<N>(in, "weight", least, 1e9));
            });
      });
}

#define BALLBOT_INSTANTIATE(N)   \
  template class TimeSignal<N>;  \
  template class TimedWeight<N>; \
  template Eigen::Matrix<double, N, 1> readVector<N>(ConfigReader&, const char*, double, double);
BALLBOT_INSTANTIATE(1)
BALLBOT_INSTANTIATE(2)
BALLBOT_INSTANTIATE(3)
#undef BALLBOT_INSTANTIATE
#if BALLBOT_ARM_JOINTS > 3  // whose references have a size of their own
template class TimeSignal<kArmJointCount>;
template class TimedWeight<kArmJointCount>;
#endif

}  // namespace ballbot
