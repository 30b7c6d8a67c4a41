#include "hil/identify/identify.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

// The loop's images in the motor torque are a hundredth of it, so they settle at once.
constexpr int kRounds = 3;
// Of the low-pass of the balance, in samples: blocked rotors turn back and forth quickly.
constexpr int kBlockedWidth = 2, kMovingWidth = 7;
const char* const kResponse = "response";

bool isOfResponse(const Record& r) {
  return r.posture == Posture::kBlocked && r.name.rfind(kResponse, 0) == 0;
}

double periodOf(const std::vector<Record>& records) { return records.front().period; }

std::vector<ResponseRecord> fittedResponses(const std::vector<Record>& records) {
  std::vector<ResponseRecord> out;
  for (const Record& r : records) {
    if (isOfResponse(r) && !r.held_out) out.emplace_back(r);
  }
  if (out.empty()) throw InputError("identify: there is no blocked record 'response'");
  return out;
}

void requirePostures(const std::vector<Record>& records) {
  for (const Posture posture : {Posture::kBlocked, Posture::kFree}) {
    const bool there = std::any_of(records.begin(), records.end(), [&](const Record& r) {
      return r.posture == posture && !r.held_out && !isOfResponse(r);
    });
    if (there) continue;
    throw InputError(
        fmt::format("identify: there is no record of a {} output; friction of rotor "
                    "and spring cannot be told from each other without it",
                    toText(posture)));
  }
}

MomentumBalance balanceFor(const Record& record, const IdentifyOptions& options) {
  return {record, options.least_speed,
          record.posture == Posture::kBlocked ? kBlockedWidth : kMovingWidth};
}

/// Of one posture in the fit. A blocked output's encoder stands still, so all blocked records have
/// one zero.
struct Fitted {
  double zero = 0, residual = 0;
};
Fitted fittedOf(Posture posture, const std::vector<MomentumBalance>& balances,
                const BalanceFit& fit) {
  for (std::size_t i = 0; i < balances.size(); ++i) {
    if (balances[i].record().posture == posture) return {fit.zeros[i], fit.residuals[i]};
  }
  return {};
}

void takeImagesOff(MomentumBalance& balance, const DriveLoop& loop) {
  if (balance.record().repeats > 0) balance.correctTorque(torqueImagesOf(balance.record(), loop));
}

void fitResponses(Identification& out, double period) {
  out.first = fitTorqueResponse(out.points, 1, period);
  out.second = fitTorqueResponse(out.points, 2, period);
}

/// Without a model of the motor: the response as it is.
Identification identifyResponse(const std::vector<Record>& records,
                                const IdentifyOptions& options) {
  Identification out;
  const BalanceVector nothing = BalanceVector::Zero();
  for (const LoopLine& l : linesOf(fittedResponses(records), nothing, 0)) {
    out.points.push_back({l.frequency_Hz, l.shown / l.sent});
  }
  fitResponses(out, periodOf(records));
  out.figures = figuresOf(out.second);
  for (const Record& r : records) {
    if (!isOfResponse(r) || !r.held_out) continue;
    out.validation.push_back(
        validateResponse(r, ResponseRecord(r).lines(nothing, 0), out.second, options.limits));
  }
  return out;
}

void validate(Identification& out, const std::vector<Record>& records,
              const std::vector<MomentumBalance>& balances, const IdentifyOptions& options) {
  const BalanceVector& p = out.balance.value;
  const DriveLoop loop(p, out.loop.value, options.assumed_stiffness);
  const double blocked_zero = fittedOf(Posture::kBlocked, balances, out.balance).zero;
  for (const Record& r : records) {
    if (!r.held_out) continue;
    if (isOfResponse(r)) {
      out.validation.push_back(validateLoop(r, ResponseRecord(r).lines(p, blocked_zero), loop,
                                            options.assumed_stiffness, out.loop.shown_residual,
                                            options.limits));
      continue;
    }
    MomentumBalance balance = balanceFor(r, options);
    takeImagesOff(balance, loop);
    const Fitted fitted = fittedOf(r.posture, balances, out.balance);
    const double zero = r.posture == Posture::kBlocked ? fitted.zero : zeroOf(balance, p);
    out.validation.push_back(validateBalance(balance, p, zero, fitted.residual, options.limits));
  }
}

}  // namespace

bool Identification::valid() const { return complaint().empty(); }

std::string Identification::complaint() const {
  for (const Validation& v : validation) {
    if (v.good) continue;
    return fmt::format(
        "the model does not fit record '{}', which was held out: {} to {:.1f} %, and what is left "
        "is "
        "{:.2g} times that of the fitted record",
        v.record, v.what, v.fit_percent, v.growth);
  }
  return "";
}

Identification identify(const std::vector<Record>& records, const IdentifyOptions& options) {
  if (!showsCurrent(records)) return identifyResponse(records, options);
  requirePostures(records);
  const double k0 = options.assumed_stiffness;
  const std::vector<ResponseRecord> responses = fittedResponses(records);
  std::vector<MomentumBalance> balances;
  bool back_driven = false;
  for (const Record& r : records) {
    if (r.held_out || isOfResponse(r)) continue;
    balances.push_back(balanceFor(r, options));
    back_driven = back_driven || r.posture == Posture::kBackDriven;
  }
  Identification out;
  out.has_current = true;
  for (int round = 0; round < kRounds; ++round) {
    out.balance = fitBalance(balances, round > 0 ? &out.balance : nullptr);
    const double zero = fittedOf(Posture::kBlocked, balances, out.balance).zero;
    out.loop = fitLoop(responses, out.balance.value, zero, k0, periodOf(records));
    const DriveLoop loop(out.balance.value, out.loop.value, k0);
    out.points = linearPoints(linesOf(responses, out.balance.value, zero), loop, k0);
    for (std::size_t i = 0; i < balances.size(); ++i) {
      takeImagesOff(balances[i], loop);
      if (round > 0 || balances[i].record().posture == Posture::kBlocked) continue;
      balances[i].leaveOutFlanks(out.balance.zeros[i], out.balance.value[kBacklash]);
    }
  }
  fitResponses(out, periodOf(records));
  out.figures = figuresOf(out.balance, out.loop, k0, back_driven);
  validate(out, records, balances, options);
  return out;
}

}  // namespace ballbot
