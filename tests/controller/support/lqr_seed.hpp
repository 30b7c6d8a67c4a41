#pragma once

#include "controller/mpc_engine.hpp"

namespace ballbot {

/// A first guess for an engine: to stand still, by the LQR.
inline MpcPolicy lqrSeed(const MpcEngine& engine, const LqrSolution& lqr) {
  MpcPolicy seed = engine.emptyPolicy();
  for (auto& knot : seed.knots()) knot.x << lqr.equilibrium.x, Vector3::Zero();
  for (auto& control : seed.controls()) {
    control.u << lqr.equilibrium.tau, ContactInput::Zero();
    control.K.topLeftCorner<kJointCount, kStateDim>() = lqr.K;
  }
  seed.setValid(kSimStart);
  return seed;
}

}  // namespace ballbot
