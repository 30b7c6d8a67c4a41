#include "hil/identify/loop_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/error.hpp"
#include "hil/identify/spectrum.hpp"

namespace ballbot {
namespace {

constexpr int kIterations = 80, kWeighings = 4;
const LoopVector kStart(3, 0.1, 5e-4, 5e-4);
constexpr Eigen::Index kBlockRows = 16;               // four lines of four errors
constexpr int kFiner = 8;                             // points between two samples
constexpr double kSmall = 1e-6, kBalanceStep = 1e-4;  // of numerical slopes, of the sizes below
// Sizes of the unknowns: of steps of their slopes.
const LoopVector kScale = (LoopVector() << 1, 0.1, 1e-3, 1e-3).finished();
const BalanceVector kBalanceScale =
    (BalanceVector() << 0.1, 300, 0.2, 0.3, 0.5, 0.1, 1e-3).finished();

/// Errors of all lines, each kind over its own size.
struct Weighing {
  double shown = 1, motor = 1;
};

Eigen::VectorXd errorsAt(const std::vector<LoopLine>& lines, const BalanceVector& p,
                         const LoopVector& q, double k0, double period, const Weighing& size) {
  const DriveLoop loop(p, q, k0);
  Eigen::VectorXd out(4 * static_cast<int>(lines.size()));
  int row = 0;
  for (const LoopLine& line : lines) {
    const LoopError e = loopError(line, loop, k0, period);
    out[row++] = e.shown.real() / size.shown;
    out[row++] = e.shown.imag() / size.shown;
    out[row++] = e.motor.real() / size.motor;
    out[row++] = e.motor.imag() / size.motor;
  }
  return out;
}

/// Standard deviations of real and imaginary parts; the unknowns are shared by both kinds.
Weighing sizesAt(const std::vector<LoopLine>& lines, const BalanceVector& p, const LoopVector& q,
                 double k0, double period) {
  const DriveLoop loop(p, q, k0);
  double shown = 0, motor = 0;
  for (const LoopLine& line : lines) {
    const LoopError e = loopError(line, loop, k0, period);
    shown += std::norm(e.shown);
    motor += std::norm(e.motor);
  }
  const double freedom = 2 * static_cast<double>(lines.size()) - 0.5 * kLoopCount;
  return {std::sqrt(shown / freedom), std::sqrt(motor / freedom)};
}

using LoopMatrix = Eigen::Matrix<double, kLoopCount, kLoopCount>;

/// The search for one weighing: where it stands, its errors and their slopes by kScale.
class Search {
 public:
  Search(const std::vector<LoopLine>& lines, const BalanceVector& p, double k0, double period)
      : lines_(lines), p_(p), k0_(k0), period_(period) {}

  void run(LoopVector& q, const Weighing& size) {
    size_ = size;
    errors = at(q);
    differentiate(q);
    double damping = 1e-3;
    for (int i = 0; i < kIterations && damping < 1e9; ++i) {
      LoopMatrix A = slope.transpose() * slope;
      A.diagonal() *= 1 + damping;
      const LoopVector next = q - kScale.cwiseProduct(A.ldlt().solve(slope.transpose() * errors));
      const bool possible = next.allFinite() && next[kLogGain] < 20 && next[kLag] > 0;
      const Eigen::VectorXd there = possible ? at(next) : errors;
      if (!(there.squaredNorm() < errors.squaredNorm())) {
        damping *= 8;
        continue;
      }
      const bool settled =
          errors.squaredNorm() - there.squaredNorm() < 1e-12 * errors.squaredNorm();
      q = next;
      errors = there;
      differentiate(q);
      damping *= 0.2;
      if (settled) break;
    }
  }
  const Weighing& size() const { return size_; }

  Eigen::VectorXd errors;
  Eigen::Matrix<double, Eigen::Dynamic, kLoopCount> slope;

 private:
  Eigen::VectorXd at(const LoopVector& q) const {
    return errorsAt(lines_, p_, q, k0_, period_, size_);
  }
  void differentiate(const LoopVector& q) {
    slope.resize(errors.size(), kLoopCount);
    for (int i = 0; i < kLoopCount; ++i) {
      LoopVector moved = q;
      moved[i] += kSmall * kScale[i];
      slope.col(i) = (at(moved) - errors) / kSmall;
    }
  }

  const std::vector<LoopLine>& lines_;
  BalanceVector p_;
  double k0_, period_;
  Weighing size_;
};

/// Covariance of the scores from sums over blocks of neighbouring frequencies, within which errors
/// may depend on each other: those of the model do.
LoopMatrix scoresOf(const Search& search) {
  LoopMatrix middle = LoopMatrix::Zero();
  int blocks = 0;
  const Eigen::Index rows = search.errors.size();
  for (Eigen::Index first = 0; first < rows; first += kBlockRows, ++blocks) {
    const Eigen::Index n = std::min(kBlockRows, rows - first);
    const LoopVector score =
        search.slope.middleRows(first, n).transpose() * search.errors.segment(first, n);
    middle += score * score.transpose();
  }
  return middle * blocks / std::max(1, blocks - kLoopCount);
}

}  // namespace

ResponseRecord::ResponseRecord(const Record& record) {
  const auto period = [&](const std::vector<double>& x) { return meanPeriod(x, record.repeats); };
  const double period_s = record.repeats * record.period;
  const Spectrum sent = spectrumOf(period(record.sent));
  const Spectrum deflection = spectrumOf(period(record.deflection()));
  const Spectrum motor_angle = spectrumOf(period(record.motor_angle));
  const auto shown = period(record.joint_torque), motor = period(record.motor_torque);
  numbers_ = excitedLines(sent);
  for (const int k : numbers_) {
    const auto n = static_cast<std::size_t>(k);
    linear_.push_back(
        {k / period_s, sent[n], lineOf(shown, k), deflection[n], lineOf(motor, k), 0});
  }
  const int count = kFiner * record.repeats;
  velocity_ = sampledFinely(derivativeOf(motor_angle, period_s), count);
  rate_ = sampledFinely(derivativeOf(deflection, period_s), count);
  deflection_ = sampledFinely(deflection, count);
}

// Dry friction, and what spring and its damping give less than without backlash.
std::vector<double> ResponseRecord::nonlinearTorque(const BalanceVector& p, double zero) const {
  std::vector<double> out(velocity_.size());
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double sign = velocity_[n] > 0 ? 1 : -1, from_zero = deflection_[n] - zero;
    const BalanceTerms t = balanceTerms(p, sign, from_zero, rate_[n], velocity_[n]);
    const double linear = p[kStiffness] * from_zero + p[kSpringDamping] * rate_[n];
    out[n] = t.dry_friction + t.spring - linear;
  }
  return out;
}

std::vector<LoopLine> ResponseRecord::lines(const BalanceVector& balance, double zero) const {
  const std::vector<double> nonlinear = nonlinearTorque(balance, zero);
  const std::vector<Complex> torques = linesAt(nonlinear, numbers_);
  std::vector<LoopLine> out = linear_;
  for (std::size_t i = 0; i < out.size(); ++i) out[i].nonlinear = torques[i];
  return out;
}

std::vector<LoopLine> linesOf(const std::vector<ResponseRecord>& records,
                              const BalanceVector& balance, double zero) {
  std::vector<LoopLine> out;
  for (const ResponseRecord& r : records) {
    for (const LoopLine& line : r.lines(balance, zero)) out.push_back(line);
  }
  std::stable_sort(out.begin(), out.end(), [](const LoopLine& a, const LoopLine& b) {
    return a.frequency_Hz < b.frequency_Hz;
  });
  return out;
}

LoopError loopError(const LoopLine& l, const DriveLoop& loop, double k0, double period) {
  const double f = l.frequency_Hz;
  const Complex deflection =
      loop.sampledDeflection(f, period) * l.sent - l.nonlinear / loop.impedance(f);
  const Complex motor = loop.sampledMotorTorque(f, period) * l.sent +
                        loop.meanAgainstFriction(f, period) * l.nonlinear;
  return {k0 * (deflection - l.deflection), motor - l.motor};
}

LoopFit fitLoop(const std::vector<ResponseRecord>& records, const BalanceVector& p, double zero,
                double k0, double period) {
  const std::vector<LoopLine> lines = linesOf(records, p, zero);
  if (lines.size() < kLoopCount) {
    throw NumericalError("too few frequencies determine no torque loop");
  }
  Search search(lines, p, k0, period);
  LoopFit fit;
  fit.value = kStart;
  for (int w = 0; w < kWeighings; ++w) {
    search.run(fit.value, w == 0 ? Weighing{} : sizesAt(lines, p, fit.value, k0, period));
  }
  const auto ldlt = LoopMatrix(search.slope.transpose() * search.slope).ldlt();
  if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 0)) {
    throw NumericalError("the measured response determines no torque loop");
  }
  const LoopMatrix scale = kScale.asDiagonal();
  const LoopMatrix inverse = ldlt.solve(LoopMatrix::Identity());
  fit.covariance = scale * inverse * scoresOf(search) * inverse * scale;
  for (int i = 0; i < kBalanceCount; ++i) {
    BalanceVector moved = p;
    moved[i] += kBalanceStep * kBalanceScale[i];
    const Eigen::VectorXd change =
        (errorsAt(linesOf(records, moved, zero), moved, fit.value, k0, period, search.size()) -
         search.errors) /
        (kBalanceStep * kBalanceScale[i]);
    fit.sensitivity.col(i) = -scale * ldlt.solve(search.slope.transpose() * change);
  }
  const Weighing size = sizesAt(lines, p, fit.value, k0, period);
  fit.shown_residual = size.shown;
  fit.motor_residual = size.motor;
  return fit;
}

std::vector<ResponsePoint> linearPoints(const std::vector<LoopLine>& lines, const DriveLoop& loop,
                                        double k0) {
  std::vector<ResponsePoint> out;
  for (const LoopLine& l : lines) {
    const Complex linear = l.deflection + l.nonlinear / loop.impedance(l.frequency_Hz);
    out.push_back({l.frequency_Hz, k0 * linear / l.sent});
  }
  return out;
}

std::vector<double> torqueImagesOf(const Record& record, const DriveLoop& loop) {
  const Spectrum sent = spectrumOf(meanPeriod(record.sent, record.repeats));
  Spectrum images(sent.size());
  for (const int k : excitedLines(sent)) {
    const auto n = static_cast<std::size_t>(k);
    images[n] = loop.torqueImages(k / (record.repeats * record.period), record.period) * sent[n];
  }
  const std::vector<double> period = sampledFinely(images, record.repeats);
  std::vector<double> out(record.sent.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = period[i % period.size()];
  return out;
}

}  // namespace ballbot
