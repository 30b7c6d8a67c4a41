#pragma once

#include "model/ldlt.hpp"
#include "model/newton_euler.hpp"

namespace ballbot {

/// M(q)^-1, what turns generalised forces into accelerations. A rigid arm has no equations of
/// motion: its joints do not accelerate, and what acts on them does nothing to base and ball.
template <typename Scalar, bool kSpin = false>
class InverseMass {
 public:
  using Pass = NewtonEuler<Scalar, kSpin>;

  InverseMass(const DynamicsConstants& constants, const Pass& pass)
      : rigid_arm_(constants.rigid_arm), factors_(ofWhatMoves(pass.massMatrix(), rigid_arm_)) {}

  /// x := M^-1 x.
  template <typename Vector>
  void multiplyInPlace(Vector&& x) const {
    factors_.solveInPlace(x);
    if (!rigid_arm_) return;
    for (int i = 0; i < kArmJointCount; ++i) x[kArmRate1 + i] = Scalar(0);
  }

 private:
  using Matrix = typename Pass::Mass;

  static Matrix ofWhatMoves(Matrix M, bool rigid_arm) {
    if (!rigid_arm) return M;
    M.template middleCols<kArmJointCount>(kArmRate1).setConstant(Scalar(0));
    M.template middleRows<kArmJointCount>(kArmRate1).setConstant(Scalar(0));
    for (int i = 0; i < kArmJointCount; ++i) M(kArmRate1 + i, kArmRate1 + i) = Scalar(1);
    return M;
  }

  bool rigid_arm_;
  Ldlt<Scalar, Pass::kVelocities> factors_;
};

}  // namespace ballbot
