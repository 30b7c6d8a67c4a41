#pragma once

#include "model/state.hpp"

namespace ballbot {

// Rigid-body algebra with one common origin and one set of axes for all bodies, templated on the
// scalar. Products are written out because Eigen's cross() and dot() conjugate complex scalars,
// which would break complex-step differentiation.

template <typename A, typename B>
Eigen::Matrix<typename A::Scalar, 3, 1> cross(const A& a, const B& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename A, typename B>
typename A::Scalar dot(const A& a, const B& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Motion of a rigid body: its angular part, and the linear part of the body-fixed point that is
/// just at the origin. The velocity at p is linear + angular x p.
template <typename Scalar>
struct Motion {
  Eigen::Matrix<Scalar, 3, 1> angular, linear;

  Motion operator+(const Motion& o) const { return {angular + o.angular, linear + o.linear}; }
  Motion operator*(const Scalar& s) const { return {s * angular, s * linear}; }
};

/// A force with its moment about the origin.
template <typename Scalar>
struct Wrench {
  Eigen::Matrix<Scalar, 3, 1> moment, force;

  Wrench operator+(const Wrench& o) const { return {moment + o.moment, force + o.force}; }
  Wrench operator*(const Scalar& s) const { return {s * moment, s * force}; }
};

/// Rate of change of `m` carried along by `v`.
template <typename Scalar>
Motion<Scalar> cross(const Motion<Scalar>& v, const Motion<Scalar>& m) {
  return {cross(v.angular, m.angular), cross(v.angular, m.linear) + cross(v.linear, m.angular)};
}
/// Rate of change of `f` carried along by `v`.
template <typename Scalar>
Wrench<Scalar> cross(const Motion<Scalar>& v, const Wrench<Scalar>& f) {
  return {cross(v.angular, f.moment) + cross(v.linear, f.force), cross(v.angular, f.force)};
}
/// Power of a wrench along a motion.
template <typename Scalar>
Scalar dot(const Motion<Scalar>& m, const Wrench<Scalar>& f) {
  return dot(m.angular, f.moment) + dot(m.linear, f.force);
}

/// Mass distribution about the origin: mass, sum of m p and sum of m p p^T.
template <typename Scalar>
struct MassMoments {
  double mass;
  Eigen::Matrix<Scalar, 3, 1> first;
  Eigen::Matrix<Scalar, 3, 3> second;

  /// Moment of inertia times w.
  Eigen::Matrix<Scalar, 3, 1> inertiaTimes(const Eigen::Matrix<Scalar, 3, 1>& w) const {
    return second.trace() * w - second * w;
  }
  /// Momentum of a motion, or the wrench of an acceleration.
  Wrench<Scalar> operator*(const Motion<Scalar>& m) const {
    return {inertiaTimes(m.angular) + cross(first, m.linear),
            Scalar(mass) * m.linear + cross(m.angular, first)};
  }
  void operator+=(const MassMoments& o) {
    mass += o.mass;
    first += o.first;
    second += o.second;
  }
};

/// What velocity adds to the equations of a body, and their derivatives with it: Q = sum of
/// m v(p) p^T and the linear momentum.
///
/// For bodies in motion V the term 2 B(V) M = V x* (I M) - I (V x M) + M x* (I V) of the derivative
/// of Newton-Euler equations (Singh, Russell, Wensing: "Efficient Analytical Derivatives of
/// Rigid-Body Dynamics Using Spatial Vector Algebra", 2022) is, particle by particle, the force
/// 2 m (M.angular x v(p)) at p; so it depends on the angular part of M alone.
template <typename Scalar>
struct VelocityMoments {
  Eigen::Matrix<Scalar, 3, 3> Q;
  Eigen::Matrix<Scalar, 3, 1> momentum;

  VelocityMoments() = default;
  VelocityMoments(const MassMoments<Scalar>& body, const Motion<Scalar>& v)
      : Q(v.linear * body.first.transpose()),
        momentum(Scalar(body.mass) * v.linear + cross(v.angular, body.first)) {
    for (int k = 0; k < 3; ++k) {
      Q.col(k) += cross(v.angular, Eigen::Matrix<Scalar, 3, 1>(body.second.col(k)));
    }
  }
  void operator+=(const VelocityMoments& o) {
    Q += o.Q;
    momentum += o.momentum;
  }
  /// B(V) M, a function of w = M.angular. With M = V it is V x* (I V).
  Wrench<Scalar> coriolis(const Eigen::Matrix<Scalar, 3, 1>& w) const {
    return {Q.trace() * w - Q * w, cross(w, momentum)};
  }
  /// B(V)^T applied to a motion: dot(s, coriolis(w)) = dot(coriolisTransposed(s), w).
  Eigen::Matrix<Scalar, 3, 1> coriolisTransposed(const Motion<Scalar>& s) const {
    return Q.trace() * s.angular - Q.transpose() * s.angular + cross(momentum, s.linear);
  }
};

}  // namespace ballbot
