#pragma once

#include <complex>
#include <vector>

namespace ballbot {

using Complex = std::complex<double>;

/// One period of a signal that repeats, by its Fourier coefficients: x(t) = sum c_k e^(j 2 pi k t).
/// Index k from 0 to half the samples, those below zero are the conjugates.
using Spectrum = std::vector<Complex>;

/// Mean over the whole periods of a record. @param repeats  samples of a period
std::vector<double> meanPeriod(const std::vector<double>& signal, int repeats);

Spectrum spectrumOf(const std::vector<double>& period);
/// The coefficient of one line alone.
Complex lineOf(const std::vector<double>& period, int k);

/// Those of several lines.
std::vector<Complex> linesAt(const std::vector<double>& period, const std::vector<int>& lines);

/// The signal, band-limited as sampling left it, at `count` instants of its period.
std::vector<double> sampledFinely(const Spectrum& spectrum, int count);

/// d/dt. @param period_s  length of the period [s]
Spectrum derivativeOf(Spectrum spectrum, double period_s);

/// Lines of an excitation: those of more than a hundredth of the strongest.
std::vector<int> excitedLines(const Spectrum& spectrum);

}  // namespace ballbot
