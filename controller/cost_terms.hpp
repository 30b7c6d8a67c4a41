#pragma once

#include <algorithm>
#include <array>

namespace ballbot {

/// What a cost is made of: the tasks, then the barriers, then what stands for all that comes after
/// the horizon.
enum CostTerm : int {
  kEndEffectorPositionCost,
  kEndEffectorOrientationCost,
  kEndEffectorTwistCost,
  kBallPositionCost,
  kYawCost,
  kBallVelocityCost,
  kBaseRateCost,
  kArmPositionCost,
  kArmRateCost,
  kWheelTorqueCost,
  kArmTorqueCost,
  kContactForceCost,
  kContactMomentCost,
  kTorqueLimitCost,
  kFrictionConeCost,
  kArmPositionLimitCost,
  kArmRateLimitCost,
  kWheelRateLimitCost,
  kTiltLimitCost,
  kTerminalCost,
  kCostTermCount
};

/// Tasks that a plan can have beside those with a term of their own.
constexpr int kMaxAddedTasks = 8;

/// Name of a term as it appears in records, e.g. "ee_position".
const char* costTermName(CostTerm term);

/// A cost split by term, and how far the worst inequality is violated, each in its own unit
/// (N m, N, rad, rad/s); 0 if all hold. The solver's Cost (solver/cost_contract.hpp).
struct CostTerms {
  static constexpr int kCount = kCostTermCount;
  std::array<double, kCostTermCount> value{};
  std::array<double, kMaxAddedTasks> added{};  ///< of the tasks added, in their order
  double violation = 0;

  double total() const {
    double sum = 0;
    for (double v : value) sum += v;
    for (double v : added) sum += v;
    return sum;
  }
  CostTerms& operator+=(const CostTerms& other) {
    for (int i = 0; i < kCostTermCount; ++i) value[i] += other.value[i];
    for (int i = 0; i < kMaxAddedTasks; ++i) added[i] += other.added[i];
    violation = std::max(violation, other.violation);
    return *this;
  }
};

}  // namespace ballbot
