#include <complex>

#include <Eigen/LU>

#include "model/frames.hpp"
#include "model/newton_euler.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

void ReducedDynamics::linearize(const StateVector& x, const JointVector& tau,
                                const Vector3& lambda_W, Linearization& out) const {
  using Complex = std::complex<double>;
  using Pass = NewtonEuler<Complex>;
  // Complex step: exact to rounding, because no difference is taken.
  const double step = 1e-40;
  const Eigen::Matrix<Complex, kJointCount, 1> tau_c = tau.cast<Complex>();
  const Eigen::Matrix<Complex, 3, 1> lambda_c = lambda_W.cast<Complex>();
  const MassMatrix M_inverse = massMatrix(x.head<kPositionDim>()).inverse();
  out.f = derivative(x, tau, lambda_W);
  const Pass::Vec8 acceleration = out.f.tail<kVelocityDim>().cast<Complex>();
  for (int i = 0; i < kStateDim; ++i) {
    Eigen::Matrix<Complex, kStateDim, 1> z = x.cast<Complex>();
    z[i] += Complex(0, step);
    const Pass::Vec8 q = z.head<kPositionDim>(), nu = z.tail<kVelocityDim>();
    const Pass pass(*constants_, q);
    const Pass::Vec8 residual = pass.massMatrix() * acceleration + pass.nonlinearEffects(nu) -
                                pass.appliedForce(tau_c, lambda_c);
    Pass::Vec8 dq = nu;
    const Complex sy = std::sin(q[kPitch]), cy = std::cos(q[kPitch]), sx = std::sin(q[kRoll]),
                  cx = std::cos(q[kRoll]);
    const Complex turn = (sx * nu[kOmegaY] + cx * nu[kOmegaZ]) / cy;
    dq[kYaw] = turn;
    dq[kPitch] = cx * nu[kOmegaY] - sx * nu[kOmegaZ];
    dq[kRoll] = nu[kOmegaX] + sy * turn;
    out.df_dx.col(i) << dq.imag() / step, -(M_inverse * residual.imag()) / step;
  }
  out.df_dtau.setZero();
  out.df_dtau.bottomRows<kVelocityDim>() =
      M_inverse * selectionMatrix(x.head<kPositionDim>()).transpose();
  out.df_dlambda.setZero();
  out.df_dlambda.bottomRows<kVelocityDim>() =
      M_inverse * endEffectorJacobian(x.head<kPositionDim>()).topRows<3>().transpose();
}

}  // namespace ballbot
