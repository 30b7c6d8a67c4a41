#include "plant/face_contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/config_visitor.hpp"

namespace ballbot {

void ContactParameters::describe(ConfigVisitor& v) {
  v.number(may("stiffness_N_per_m", "of the contact's spring across the face"), stiffness,
           {1, 1e5});
  v.number(may("damping_Ns_per_m", "of the contact's damper across the face"), damping, {0, 1e3});
  v.number(may("friction", "coefficient of friction along the face"), friction, {0, 10});
  v.number(may("tangential_stiffness_N_per_m", "along the face, while the point sticks"),
           tangential_stiffness, {1, 1e5});
  v.number(may("tangential_damping_Ns_per_m", "along the face, while the point sticks"),
           tangential_damping, {0, 1e3});
}

Matrix3 faceAxes(double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  Matrix3 R;
  R << -s, 0, c,  //
      c, 0, s,    //
      0, 1, 0;
  return R;
}

Touch touch(const ContactParameters& p, const Face& face, const Vector3& p_WP,
            const Vector3& v_WP_W, const Eigen::Vector2d& stretch) {
  Touch out;
  const Vector3 arm_W = p_WP - face.p_WF;
  const Vector3 p_FP = face.R_WF.transpose() * arm_W;
  const double depth = -p_FP.z();
  if (depth <= 0 || depth > kFaceThickness || p_FP.x() < face.x_low || p_FP.x() > face.x_high ||
      p_FP.y() < 0 || p_FP.y() > face.height) {
    return out;
  }
  const Vector3 carried = face.rate * Vector3(-arm_W.y(), arm_W.x(), 0);
  const Vector3 v_F = face.R_WF.transpose() * (v_WP_W - carried);
  const double damping = p.damping * std::min(1.0, depth / kContactOnset);
  const double normal = std::max(0.0, p.stiffness * depth - damping * v_F.z());

  out.slip = v_F.head<2>();
  out.limit = stretch;
  const double most = p.friction * normal;
  const double held = p.tangential_stiffness * stretch.norm();
  if (held > most) out.limit *= most / held;
  Eigen::Vector2d tangential =
      -(p.tangential_stiffness * stretch + p.tangential_damping * out.slip);
  const double wanted = tangential.norm();
  out.phase = wanted > most ? ContactPhase::kSliding : ContactPhase::kSticking;
  if (wanted > most) tangential *= most / wanted;

  out.force_W = face.R_WF * Vector3(tangential.x(), tangential.y(), normal);
  out.foot_W = p_WP + depth * face.R_WF.col(2);
  out.stored =
      0.5 * p.stiffness * depth * depth + 0.5 * p.tangential_stiffness * stretch.squaredNorm();
  return out;
}

}  // namespace ballbot
