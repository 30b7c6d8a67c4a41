#pragma once

#include "solver/frequency_shaping.hpp"
#include "solver/riccati.hpp"

// Augments a problem by the filter state x_f of one shaped input (FrequencyShaping): state `at`,
// the filter of input i, at the values xf and u. The cost is 1/2 w (r u)^2, of a stage of fixed
// length or as a rate.

namespace ballbot {

/// Adds the cost's expansion 1/2 w (H u^2 + 2 c1 u d + c2 d^2), d = u - x_f, to R, r, Q and q, and
/// sets its element of P.
template <int NX, int NU>
void expandShapedCost(const FilterStep& f, double w, int at, int i, double xf, double u,
                      LqStage<NX, NU>& lq) noexcept {
  auto R = lq.R();
  auto r = lq.r();
  auto Q = lq.Q();
  auto q = lq.q();
  const double d = u - xf;
  R(i, i) += w * (f.H + 2 * f.c1 + f.c2);
  r[i] += w * (f.H * u + f.c1 * (u + d) + f.c2 * d);
  Q(at, at) += w * f.c2;
  q[at] += -w * (f.c1 * u + f.c2 * d);
  lq.Pt()(at, i) = -w * (f.c1 + f.c2);
}

/// Sets the filter's elements of A and B over a step.
template <int NX, int NU>
void linearizeFilter(const FilterStep& f, int at, int i, LqStage<NX, NU>& lq) noexcept {
  lq.A()(at, at) = f.a;
  lq.B()(at, i) = 1 - f.a;
}

/// In continuous time, all of it: sets the filter's elements of A and B, adds the expansion of the
/// rate 1/2 w (rho u - (rho - 1) x_f)^2 to R, r, Q and q, and sets its element of P.
template <int NX, int NU>
void expandShapedRate(const FrequencyShaping& shaping, double w, int at, int i, double xf, double u,
                      LqStage<NX, NU>& rates) noexcept {
  auto R = rates.R();
  auto r = rates.r();
  auto Q = rates.Q();
  auto q = rates.q();
  const double rho = shaping.rho();
  const double shaped = rho * u - (rho - 1) * xf;
  rates.A()(at, at) = -shaping.pole;
  rates.B()(at, i) = shaping.pole;
  R(i, i) += w * rho * rho;
  r[i] += w * rho * shaped;
  Q(at, at) += w * (rho - 1) * (rho - 1);
  q[at] -= w * (rho - 1) * shaped;
  rates.Pt()(at, i) = -w * rho * (rho - 1);
}

}  // namespace ballbot
