#include "plant/spin_friction.hpp"

#include "core/config_visitor.hpp"

namespace ballbot {

void FloorPatch::describe(ConfigVisitor& v) {
  v.vector(must("center_m", "of the disc, in W"), center_W);
  v.number(must("radius_m", "of the disc"), radius, {1e-3, kInf});
  v.number(must("torque_Nm", "of the floor there on a ball that spins"), torque, {0, 1000});
}

double SpinFriction::heldAt(const Eigen::Vector2d& p_WK) const noexcept {
  double held = torque;
  for (const FloorPatch& patch : patches) {
    if ((p_WK - patch.center_W).squaredNorm() <= patch.radius * patch.radius) held = patch.torque;
  }
  return held;
}

void SpinFriction::describe(ConfigVisitor& v) {
  v.number(may("torque_Nm", "of the floor on a ball that spins"), torque, {0, 1000});
  v.number(may("smoothing_rad_per_s", "spin at which three quarters of the torque are reached"),
           smoothing, {1e-4, 10});
  v.list(may("patches", "discs of the floor that hold a spin with another torque; the last counts"),
         [&](ConfigVisitor& in) { patches.emplace_back().describe(in); });
}

}  // namespace ballbot
