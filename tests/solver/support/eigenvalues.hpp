#pragma once

#include <Eigen/Core>

namespace ballbot {

// Of any size on purpose, and compiled once: a solver for a fixed size costs the compiler half a
// minute.

Eigen::VectorXcd eigenvaluesOf(const Eigen::MatrixXd& A);
Eigen::VectorXcd complexEigenvaluesOf(const Eigen::MatrixXcd& A);
/// Of a symmetric matrix, rising.
Eigen::VectorXd symmetricEigenvaluesOf(const Eigen::MatrixXd& A);
/// Eigenvectors of the eigenvalues with a negative real part, one a column.
Eigen::MatrixXcd stableEigenvectorsOf(const Eigen::MatrixXd& A);
double smallestSingularValue(const Eigen::MatrixXcd& M);

}  // namespace ballbot
