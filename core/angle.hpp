#pragma once

namespace ballbot {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTwoPi = 2 * kPi;
constexpr double kDegPerRad = 57.295779513082320877;
constexpr double kRadPerDeg = kPi / 180;

}  // namespace ballbot
