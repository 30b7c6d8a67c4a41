#include "controller/time_signal.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr double kLongest_s = 1e6;

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
TimeSignal<N> TimeSignal<N>::read(ConfigReader& in, const Vector& initial) {
  TimeSignal out(in.has("initial") ? readVector<N>(in, "initial", -1e6, 1e6) : initial);
  for (ConfigReader& move : in.list("moves")) {
    const double at = move.number("at_s", {0, kLongest_s});
    if (move.has("circle_radius_m")) {
      if (N < 2) {
        throw InputError(fmt::format("{} needs two components, this reference has {}",
                                     move.at("circle_radius_m"), N));
      }
      const double radius = move.number("circle_radius_m", {kTiny, 100});
      const double period = move.number("period_s", {0.1, kLongest_s});
      out.circle(at, radius, period, move.numberOr("turns", 1, {kTiny, 1e6}));
    } else {
      const Vector by = readVector<N>(move, "by", -1e6, 1e6);
      out.ramp(at, move.numberOr("over_s", 0, {0, kLongest_s}), by);
    }
    move.finish();
  }
  in.finish();
  return out;
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
TimedWeight<N> TimedWeight<N>::read(ConfigReader& in, double least) {
  TimedWeight out(readVector<N>(in, "weight", least, 1e9));
  double last = -kInf;
  for (ConfigReader& change : in.list("weight_changes")) {
    const double at = change.number("at_s", {0, kLongest_s});
    if (at <= last) {
      throw InputError(fmt::format("{} is {}, must be later than the change before it, at {} s",
                                   change.at("at_s"), at, last));
    }
    last = at;
    out.change(at, readVector<N>(change, "weight", least, 1e9));
    change.finish();
  }
  return out;
}

#define BALLBOT_INSTANTIATE(N)   \
  template class TimeSignal<N>;  \
  template class TimedWeight<N>; \
  template Eigen::Matrix<double, N, 1> readVector<N>(ConfigReader&, const char*, double, double);
BALLBOT_INSTANTIATE(1)
BALLBOT_INSTANTIATE(2)
BALLBOT_INSTANTIATE(3)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
