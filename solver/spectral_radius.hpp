#pragma once

#include <functional>

#include <Eigen/Core>

namespace ballbot {

/// The size of the largest eigenvalue of a linear map that is known by what it makes of a vector:
/// of a map over one period, the factor by which what disturbs it grows from period to period.
///
/// Arnoldi's iteration from a fixed start, restarted from the leading Ritz vectors: equal maps give
/// equal bits. For maps whose largest eigenvalues are few.
/// @param map  replaces a vector of `dim` elements by its image
/// @param tolerance  on the residual of the leading eigenvalues, relative to the largest
/// @throw NumericalError if the map is not finite, or the iteration does not settle.
double spectralRadius(const std::function<void(Eigen::VectorXd&)>& map, int dim,
                      double tolerance = 1e-8);

}  // namespace ballbot
