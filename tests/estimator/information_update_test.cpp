#include "estimator/information_update.hpp"

#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "estimator/partial_ldlt.hpp"
#include "model/frames.hpp"
#include "tests/estimator/support/smooth_motion.hpp"

namespace ballbot::test {
namespace {

constexpr std::size_t kBoth = 2 * kSpinTangentDim;  // room for both kinds of filter
using LongVector = std::array<long double, kBoth>;
using LongMatrix = std::array<LongVector, kBoth>;

/// Inverse of the leading n x n block by Gauss-Jordan elimination in extended precision, written
/// out so that it shares nothing with what is tested.
LongMatrix inverted(LongMatrix A, std::size_t n) {
  LongMatrix B{};
  for (std::size_t i = 0; i < n; ++i) B[i][i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const long double pivot = A[k][k];
    for (std::size_t j = 0; j < n; ++j) {
      A[k][j] /= pivot;
      B[k][j] /= pivot;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const long double f = A[i][k];
      for (std::size_t j = 0; j < n; ++j) {
        A[i][j] -= f * A[k][j];
        B[i][j] -= f * B[k][j];
      }
    }
  }
  return B;
}

Residuals someResiduals(std::uint64_t seed) {
  const RandomStream random(seed, "update");
  const auto draw = [&](std::uint64_t i, double scale) {
    const auto n = random.normals(i);
    return Vector3(scale * Vector3(n[0], n[1], n[2]));
  };
  FilterState a;
  a.R_WB = expSO3(draw(0, 0.2));
  a.v_WK_W = draw(1, 0.3).head<2>();
  a.w_WB_B = draw(2, 0.3);
  IntervalMeasurement m;
  m.h = 2.5e-3;
  m.has_accel = m.has_gyro = true;
  m.has_wheel.fill(true);
  m.accel_B = a.R_WB.transpose() * Vector3(0.1, -0.2, 9.81) + draw(3, 0.05);
  m.gyro_B = a.w_WB_B + draw(4, 3e-3);
  m.smooth_v_old_W = a.v_WK_W;
  m.smooth_v_new_W = a.v_WK_W + Eigen::Vector2d(3e-4, -4e-4);
  m.spin_kept = 0.97;
  m.spin_sigma = 0.03;
  m.smooth_spin = 0.4;
  const ResidualModel model(estimatorTestRobot(), FilterNoise{});
  const FilterState b = model.predict(a, m);
  Residuals r;
  model.evaluate(a, b, m, r);  // once, to read off what the wheels should turn
  m.wheel_increment = 2.5e-4 * r.y.segment<3>(kRowWheels) + draw(5, 2.5e-4);
  model.evaluate(a, b, m, r);
  return r;
}

template <int kDim>
BasicTangentMatrix<kDim> somePrior(std::uint64_t seed) {
  using Matrix = BasicTangentMatrix<kDim>;
  const RandomStream random(seed, "prior");
  Matrix A;
  for (int i = 0; i < A.size(); ++i) A.data()[i] = random.normals(static_cast<std::uint64_t>(i))[0];
  const BasicTangentVector<kSpinTangentDim> weight =
      (BasicTangentVector<kSpinTangentDim>() << 1e2, 1e2, 300, 300, 50, 300, 300, 400, 400, 400, 30,
       30, 30, 3e3, 3e3, 3e3, 20)
          .finished();
  const Matrix W = weight.head<kDim>().asDiagonal();
  return W * (Matrix::Identity() + 0.1 * A * A.transpose()) * W;
}

/// The whole least-squares problem over old and new state at once, by inverting its matrix.
template <int kDim>
struct Reference {
  LongVector delta{};                    // old, new
  LongMatrix covariance{};               // of both
  BasicTangentMatrix<kDim> information;  // of the new state: inverse of its part of the covariance
  long double chi_square = 0;

  /// Residual of a wheel's row and variance of what the solution says about it.
  std::array<long double, 2> wheel(const Residuals& r, int i) const {
    long double value = r.y[kRowWheels + i], variance = 0;
    for (std::size_t k = 0; k < 2 * kDim; ++k) {
      value += entry(r, kRowWheels + i, k) * delta[k];
      for (std::size_t l = 0; l < 2 * kDim; ++l) {
        variance += entry(r, kRowWheels + i, k) * covariance[k][l] * entry(r, kRowWheels + i, l);
      }
    }
    return {value, variance};
  }
  static long double entry(const Residuals& r, int row, std::size_t column) {
    const int k = static_cast<int>(column);
    return k < kDim ? r.d_old(row, k) : r.d_new(row, k - kDim);
  }
};

template <int kDim>
Reference<kDim> solveAtOnce(const Eigen::Matrix<double, kDim, kDim>& prior, const Residuals& r,
                            const std::array<bool, 3>& use_wheel) {
  constexpr std::size_t kUnknowns = 2 * kDim;
  Reference<kDim> out;
  LongMatrix H{};
  LongVector g{};
  for (int k = 0; k < kDim; ++k) {
    for (int l = 0; l < kDim; ++l) {
      H[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)] = prior(k, l);
    }
  }
  for (int row = 0; row < (kDim > kTanSpin ? kResidualDim : kRowSpin); ++row) {
    const int wheel = row - kRowWheels;
    if (wheel >= 0 && wheel < 3 && !use_wheel[static_cast<std::size_t>(wheel)]) continue;
    for (std::size_t k = 0; k < kUnknowns; ++k) {
      g[k] += Reference<kDim>::entry(r, row, k) * static_cast<long double>(r.y[row]);
      for (std::size_t l = 0; l < kUnknowns; ++l) {
        H[k][l] += Reference<kDim>::entry(r, row, k) * Reference<kDim>::entry(r, row, l);
      }
    }
    out.chi_square += static_cast<long double>(r.y[row]) * r.y[row];
  }
  out.covariance = inverted(H, kUnknowns);
  for (std::size_t k = 0; k < kUnknowns; ++k) {
    for (std::size_t l = 0; l < kUnknowns; ++l) out.delta[k] -= out.covariance[k][l] * g[l];
    out.chi_square += g[k] * out.delta[k];
  }
  LongMatrix of_new{};
  for (std::size_t k = 0; k < kDim; ++k) {
    for (std::size_t l = 0; l < kDim; ++l) {
      of_new[k][l] = out.covariance[kDim + k][kDim + l];
    }
  }
  const LongMatrix information = inverted(of_new, kDim);
  for (int k = 0; k < kDim; ++k) {
    for (int l = 0; l < kDim; ++l) {
      out.information(k, l) = static_cast<double>(
          information[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)]);
    }
  }
  return out;
}

const std::array<std::array<bool, 3>, 3> kWheelChoices = {
    {{true, true, true}, {true, false, true}, {false, false, false}}};

template <int kDim>
void isTheLeastSquaresSolution() {
  using Vector = BasicTangentVector<kDim>;
  using Matrix = BasicTangentMatrix<kDim>;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Residuals r = someResiduals(seed);
    const Matrix prior = somePrior<kDim>(seed);
    for (const auto& use : kWheelChoices) {
      BasicInformationUpdate<kDim> update;
      ASSERT_TRUE(update.solve(prior, r, use));
      const Reference<kDim> reference = solveAtOnce(prior, r, use);
      Vector delta;
      for (int k = 0; k < kDim; ++k) {
        delta[k] = static_cast<double>(reference.delta[static_cast<std::size_t>(kDim + k)]);
      }
      const Matrix& information = reference.information;
      // In standard deviations, so that units do not matter.
      const Vector error = update.delta() - delta;
      EXPECT_LT(std::sqrt(error.dot(information * error)), 1e-6);
      EXPECT_NEAR(update.chiSquare(), static_cast<double>(reference.chi_square), 1e-6);
      const Vector sigma = information.diagonal().cwiseSqrt().cwiseInverse();
      const Matrix off =
          sigma.asDiagonal() * (update.information() - information) * sigma.asDiagonal();
      EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-6);
      const Matrix root = update.covarianceRoot();
      EXPECT_LT((root * root.transpose() * update.information() - Matrix::Identity())
                    .cwiseAbs()
                    .maxCoeff(),
                1e-4);
    }
  }
}

TEST(InformationUpdate, IsTheLeastSquaresSolution) { isTheLeastSquaresSolution<kTangentDim>(); }

TEST(InformationUpdate, IsTheLeastSquaresSolutionWithSpin) {
  isTheLeastSquaresSolution<kSpinTangentDim>();
}

template <int kDim>
void judgesAWheelByWhatAllTheRestSays() {
  const Residuals r = someResiduals(4);
  const auto prior = somePrior<kDim>(4);
  for (const auto& use : kWheelChoices) {
    BasicInformationUpdate<kDim> update;
    ASSERT_TRUE(update.solve(prior, r, use));
    for (int i = 0; i < 3; ++i) {
      // The textbook way: leave the wheel out, predict its residual, divide by the deviation of
      // prediction and measurement together. For a wheel in use that is the same number.
      std::array<bool, 3> without = use;
      without[static_cast<std::size_t>(i)] = false;
      const auto [predicted, variance] = solveAtOnce(prior, r, without).wheel(r, i);
      EXPECT_NEAR(update.standardizedWheel(i),
                  static_cast<double>(predicted / std::sqrt(1 + variance)), 1e-6)
          << i;
    }
  }
}

TEST(InformationUpdate, JudgesAWheelByWhatAllTheRestSays) {
  judgesAWheelByWhatAllTheRestSays<kTangentDim>();
  judgesAWheelByWhatAllTheRestSays<kSpinTangentDim>();
}

TEST(InformationUpdate, AShiftTakesAwayItsSquareOfTheCost) {
  // The best multiple of a shift taken out of the wheels lowers the minimum by the square of the
  // standardised shift; found here by trying, the minimum being a parabola in that multiple.
  const Residuals r = someResiduals(6);
  const auto prior = somePrior<kSpinTangentDim>(6);
  const Vector3 shift(0.8, 1.1, -0.6);
  BasicInformationUpdate<kSpinTangentDim> update;
  for (const auto& use : {std::array<bool, 3>{true, true, true}, {true, false, true}}) {
    const auto minimum = [&](double multiple) {
      Residuals shifted = r;
      shifted.y.segment<3>(kRowWheels) -= multiple * shift;
      EXPECT_TRUE(update.solve(prior, shifted, use));
      return update.chiSquare();
    };
    const double left = minimum(-1), right = minimum(1), middle = minimum(0);
    const double expected = update.standardizedShift(shift);
    const double slope = (right - left) / 2, bend = (right + left) / 2 - middle;
    EXPECT_NEAR(expected * expected, slope * slope / (4 * bend), 1e-6);
    EXPECT_GT(std::abs(expected), 0.05);
  }
}

TEST(InformationUpdate, SaysSoWhereThereIsNoSolution) {
  const Residuals r = someResiduals(1);
  InformationUpdate update;
  TangentMatrix bad = somePrior<kTangentDim>(1);
  bad(5, 5) = -1e12;
  EXPECT_FALSE(update.solve(bad, r, {true, true, true}));
  Residuals nan = r;
  nan.y[kRowAccel] = std::nan("");
  EXPECT_FALSE(update.solve(somePrior<kTangentDim>(1), nan, {true, true, true}));
}

TEST(PartialLdlt, LeavesTheSchurComplement) {
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  const RandomStream random(1, "ldlt");
  Matrix12 A;
  for (int i = 0; i < A.size(); ++i) A.data()[i] = random.normals(static_cast<std::uint64_t>(i))[0];
  const Matrix12 S = A * A.transpose() + Matrix12::Identity();
  Matrix12 work = S;
  Eigen::Matrix<double, 12, 1> inverse_pivot;
  ASSERT_TRUE((eliminate<0, 8>(work, inverse_pivot)));
  const Eigen::Matrix4d schur =
      S.bottomRightCorner<4, 4>() -
      S.bottomLeftCorner<4, 8>() * S.topLeftCorner<8, 8>().inverse() * S.topRightCorner<8, 4>();
  const Eigen::Matrix4d left = work.bottomRightCorner<4, 4>().selfadjointView<Eigen::Lower>();
  EXPECT_LT((left - schur).norm(), 1e-12 * S.norm());
  ASSERT_TRUE((eliminate<8, 12>(work, inverse_pivot)));
  // The product of the pivots is the determinant.
  EXPECT_NEAR(inverse_pivot.prod() * S.determinant(), 1.0, 1e-9);
}

TEST(PartialLdlt, RefusesAPivotThatIsNotPositive) {
  Eigen::Matrix4d S = Eigen::Matrix4d::Identity();
  S(2, 2) = 0;
  Eigen::Vector4d inverse_pivot;
  EXPECT_FALSE((eliminate<0, 4>(S, inverse_pivot)));
}

TEST(InverseRoot, IsARootOfTheInverse) {
  const TangentMatrix spd = somePrior<kTangentDim>(2);
  const TangentMatrix negative = -spd;
  const TangentMatrix root = inverseRoot(spd);
  EXPECT_LT((root.transpose() * spd * root - TangentMatrix::Identity()).norm(), 1e-10);
  EXPECT_LT((inverseSpd(spd) * spd - TangentMatrix::Identity()).norm(), 1e-7);
  EXPECT_EQ(inverseRoot(negative), TangentMatrix::Zero());
}

}  // namespace
}  // namespace ballbot::test
