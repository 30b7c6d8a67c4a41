#include "hil/identify/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kExcitedShare = 1e-2;

/// e^(j 2 pi i / n) of all i.
std::vector<Complex> rootsOfUnity(std::size_t n) {
  std::vector<Complex> roots(n);
  for (std::size_t i = 0; i < n; ++i) {
    roots[i] = std::polar(1.0, kTwoPi * static_cast<double>(i) / static_cast<double>(n));
  }
  return roots;
}

Complex coefficient(const std::vector<double>& period, std::size_t k,
                    const std::vector<Complex>& roots) {
  Complex sum = 0;
  std::size_t turn = 0;
  for (const double x : period) {
    sum += x * std::conj(roots[turn]);
    turn += k;
    if (turn >= roots.size()) turn -= roots.size();
  }
  return sum / static_cast<double>(period.size());
}

}  // namespace

std::vector<double> meanPeriod(const std::vector<double>& signal, int repeats) {
  std::vector<double> mean(static_cast<std::size_t>(repeats));
  const std::size_t periods = signal.size() / mean.size();
  for (std::size_t n = 0; n < mean.size() * periods; ++n) {
    mean[n % mean.size()] += signal[n] / static_cast<double>(periods);
  }
  return mean;
}

Complex lineOf(const std::vector<double>& period, int k) {
  return coefficient(period, static_cast<std::size_t>(k), rootsOfUnity(period.size()));
}

std::vector<Complex> linesAt(const std::vector<double>& period, const std::vector<int>& lines) {
  const std::vector<Complex> roots = rootsOfUnity(period.size());
  std::vector<Complex> out;
  for (const int k : lines) {
    out.push_back(coefficient(period, static_cast<std::size_t>(k), roots));
  }
  return out;
}

Spectrum spectrumOf(const std::vector<double>& period) {
  const std::vector<Complex> roots = rootsOfUnity(period.size());
  Spectrum out;
  for (std::size_t k = 0; k < (period.size() + 1) / 2; ++k) {
    out.push_back(coefficient(period, k, roots));
  }
  return out;
}

std::vector<double> sampledFinely(const Spectrum& spectrum, int count) {
  const std::vector<Complex> roots = rootsOfUnity(static_cast<std::size_t>(count));
  std::vector<double> out(roots.size(), spectrum.front().real());
  for (std::size_t k = 1; k < spectrum.size(); ++k) {
    std::size_t turn = 0;
    const double re = 2 * spectrum[k].real(), im = 2 * spectrum[k].imag();
    for (double& x : out) {
      x += re * roots[turn].real() - im * roots[turn].imag();
      turn += k;
      if (turn >= roots.size()) turn -= roots.size();
    }
  }
  return out;
}

Spectrum derivativeOf(Spectrum spectrum, double period_s) {
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    spectrum[k] *= Complex(0, kTwoPi * static_cast<double>(k) / period_s);
  }
  return spectrum;
}

std::vector<int> excitedLines(const Spectrum& spectrum) {
  double strongest = 0;
  for (std::size_t k = 1; k < spectrum.size(); ++k) {
    strongest = std::max(strongest, std::abs(spectrum[k]));
  }
  std::vector<int> lines;
  for (std::size_t k = 1; k < spectrum.size(); ++k) {
    if (std::abs(spectrum[k]) > kExcitedShare * strongest) lines.push_back(static_cast<int>(k));
  }
  return lines;
}

}  // namespace ballbot
