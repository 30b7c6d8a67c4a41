#pragma once

#include "model/state.hpp"
#include "model/truth.hpp"

namespace ballbot {

class ConfigVisitor;

/// Contact of a point with a plane face, as a spring and damper across it and friction along it.
struct ContactParameters {
  double stiffness = 4000;             ///< across the face [N/m]
  double damping = 60;                 ///< across the face [N s/m]
  double friction = 0.7;               ///< coefficient mu
  double tangential_stiffness = 4000;  ///< along the face, while the point sticks [N/m]
  double tangential_damping = 60;      ///< along the face, while the point sticks [N s/m]

  void describe(ConfigVisitor& v);
};

/// A vertical rectangle that can be touched from its front. Frame F: z_F points out of the front,
/// y_F up, x_F = z_W x z_F. It may turn about the vertical through its origin.
struct Face {
  Vector3 p_WF = Vector3::Zero();  ///< origin, on the floor [m]
  Matrix3 R_WF = Matrix3::Identity();
  double rate = 0;               ///< angular velocity about z_W [rad/s]
  double x_low = 0, x_high = 0;  ///< extent along x_F [m]
  double height = 0;             ///< extent along y_F, from zero [m]
};

/// Axes of a face whose front looks along (cos heading, sin heading, 0).
Matrix3 faceAxes(double heading);

/// What a face does to a point at one instant.
struct Touch {
  ContactPhase phase = ContactPhase::kNone;
  Vector3 force_W = Vector3::Zero();  ///< on the point [N]
  Vector3 foot_W = Vector3::Zero();   ///< of the point on the face; meaningful in contact [m]
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();  ///< velocity of the point along x_F, y_F [m/s]
  Eigen::Vector2d limit =
      Eigen::Vector2d::Zero();  ///< `stretch` brought back to what friction holds [m]
  double stored = 0;            ///< energy in the springs [J]
};

/// The point is in contact when it lies behind the front by no more than kThickness, within the
/// rectangle. Force in F, with depth d, velocity v and stretch s of the tangential spring:
///
///   f_z = max(0, k d - c(d) v_z),   c grows over the first kOnset of depth to its full value,
///   f_xy = -(k_t s + c_t v_xy), shortened to mu f_z where it is longer.
///
/// s follows the point (ds/dt = v_xy) and is cut to |s| <= mu f_z / k_t after every step: below the
/// limit the point sticks and does not creep, at the limit it slides. Everything is continuous in
/// depth and velocity; none of it creates energy.
/// @param stretch  tangential displacement since the point stuck, along x_F, y_F [m]
Touch touch(const ContactParameters& p, const Face& face, const Vector3& p_WP,
            const Vector3& v_WP_W, const Eigen::Vector2d& stretch);

constexpr double kFaceThickness = 0.03;  ///< [m]
constexpr double kContactOnset = 2e-4;   ///< [m]

}  // namespace ballbot
