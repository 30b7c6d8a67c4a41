#include "tests/solver/support/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace ballbot {

Eigen::VectorXcd eigenvaluesOf(const Eigen::MatrixXd& A) { return A.eigenvalues(); }

Eigen::VectorXcd complexEigenvaluesOf(const Eigen::MatrixXcd& A) { return A.eigenvalues(); }

Eigen::VectorXd symmetricEigenvaluesOf(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXcd stableEigenvectorsOf(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(A);
  const Eigen::MatrixXcd vectors = eigen.eigenvectors();
  Eigen::MatrixXcd stable(A.rows(), A.rows());
  Eigen::Index found = 0;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (eigen.eigenvalues()[i].real() < 0) stable.col(found++) = vectors.col(i);
  }
  return stable.leftCols(found);
}

double smallestSingularValue(const Eigen::MatrixXcd& M) {
  return Eigen::JacobiSVD<Eigen::MatrixXcd>(M).singularValues().minCoeff();
}

}  // namespace ballbot
