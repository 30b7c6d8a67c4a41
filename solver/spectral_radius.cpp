#include "solver/spectral_radius.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr int kLargestBasis = 60, kLooks = 12, kRestarts = 40;
constexpr int kWarmUps = 3;           // of the first start: let what vanishes at once vanish
constexpr double kInvariant = 1e-13;  // a remainder so small, relative to its image, is rounding

/// An orthonormal basis V of a Krylov space, and the map in it: map V = V H + remainder e_m^T.
struct Krylov {
  Eigen::MatrixXd V, H;
  double remainder = 0;
  int size = 0;
};

struct Leading {
  double radius = 0, residual = 0;
  Eigen::VectorXd direction;  ///< where the leading eigenvectors point
};

Leading leadingOf(const Krylov& k) {
  const auto V = k.V.leftCols(k.size);
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(k.H.topLeftCorner(k.size, k.size));
  const Eigen::VectorXd sizes = eigen.eigenvalues().cwiseAbs();
  Leading out;
  out.radius = sizes.maxCoeff();
  out.direction = Eigen::VectorXd::Zero(V.rows());
  for (int i = 0; i < k.size; ++i) {
    if (sizes[i] < 0.9 * out.radius) continue;
    const Eigen::VectorXcd y = eigen.eigenvectors().col(i);
    out.direction += V * (y.real() + y.imag());
    if (sizes[i] >= 0.999 * out.radius) {
      out.residual = std::max(out.residual, k.remainder * std::abs(y[k.size - 1]));
    }
  }
  return out;
}

double norm(const Eigen::VectorXd& v) {
  const double size = v.norm();
  if (!std::isfinite(size)) throw NumericalError("a map is not finite: it has no spectral radius");
  return size;
}

}  // namespace

double spectralRadius(const std::function<void(Eigen::VectorXd&)>& map, int dim, double tolerance) {
  const int largest = std::min(dim, kLargestBasis);
  Eigen::VectorXd start(dim);
  for (int i = 0; i < dim; ++i) start[i] = std::cos(1.0 + 2.3 * i);  // no structure of the map's
  for (int i = 0; i < kWarmUps; ++i) {
    start /= norm(start);
    map(start);
    if (norm(start) == 0) return 0;
  }
  Krylov k;
  k.V.resize(dim, largest + 1);
  for (int restart = 0; restart < kRestarts; ++restart) {
    k.H = Eigen::MatrixXd::Zero(largest + 1, largest);
    k.V.col(0) = start / norm(start);
    for (int m = 0; m < largest; ++m) {
      Eigen::VectorXd image = k.V.col(m);
      map(image);
      const double size = norm(image);
      for (int twice = 0; twice < 2; ++twice) {  // Gram-Schmidt, repeated for orthogonality
        const Eigen::VectorXd along = k.V.leftCols(m + 1).transpose() * image;
        image -= k.V.leftCols(m + 1) * along;
        k.H.col(m).head(m + 1) += along;
      }
      k.remainder = image.norm();
      k.size = m + 1;
      const bool invariant = k.remainder <= kInvariant * size;
      if (invariant || k.size == largest || k.size % kLooks == 0) {
        const Leading leading = leadingOf(k);
        if (invariant || k.size == dim || leading.residual <= tolerance * leading.radius) {
          return leading.radius;
        }
        start = leading.direction;
      }
      k.V.col(m + 1) = image / k.remainder;
      k.H(m + 1, m) = k.remainder;
    }
  }
  throw NumericalError("the spectral radius of a map has not settled");
}

}  // namespace ballbot
