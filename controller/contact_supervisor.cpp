#include "controller/contact_supervisor.hpp"

#include <algorithm>

#include "core/config_reader.hpp"

namespace ballbot {
namespace {

constexpr double kNoForce_N = 0.05;  // asked for: as good as none

}  // namespace

ContactSupervision ContactSupervision::read(ConfigReader& in) {
  ContactSupervision o;
  o.found_at_N = in.numberOr("found_at_N", o.found_at_N, {0.1, 1e3});
  o.found_after = in.durationOr("found_after_ms", o.found_after, {0, 1e5});
  o.approach_force_N = in.numberOr("approach_force_N", o.approach_force_N, {0.1, 1e3});
  o.approach_limit = in.durationOr("approach_limit_s", o.approach_limit, {0.1, 1e3});
  o.lost_share = in.numberOr("lost_share", o.lost_share, {0, 1});
  o.lost_after = in.durationOr("lost_after_ms", o.lost_after, {1, 1e5});
  o.integral_gain = in.numberOr("integral_gain_per_s", o.integral_gain, {0, 10});
  o.integral_limit_N = in.numberOr("integral_limit_N", o.integral_limit_N, {0, 1e3});
  in.finish();
  return o;
}

void ContactSupervisor::enter(ContactState state, SimTime now) noexcept {
  state_ = state;
  entered_ = doubt_ = now;
  integral_N_ = 0;
}

void ContactSupervisor::update(SimTime now, double asked, double measured) noexcept {
  const double since_last = toSeconds(now - last_);
  last_ = now;
  if (asked < kNoForce_N) {
    if (state_ != ContactState::kNone) enter(ContactState::kNone, now);
    return;
  }
  switch (state_) {
    case ContactState::kNone:
      enter(ContactState::kApproach, now);
      break;
    case ContactState::kApproach:
      if (!(measured >= options_.found_at_N)) doubt_ = now;
      if (now - doubt_ >= options_.found_after && measured >= options_.found_at_N) {
        enter(ContactState::kContact, now);
      } else if (now - entered_ >= options_.approach_limit) {
        enter(ContactState::kLost, now);
      }
      break;
    case ContactState::kContact:
      integral_N_ = std::clamp(integral_N_ + options_.integral_gain * since_last * (asked - measured),
                               -options_.integral_limit_N, options_.integral_limit_N);
      if (measured >= options_.lost_share * asked) doubt_ = now;
      if (now - doubt_ >= options_.lost_after) enter(ContactState::kLost, now);
      break;
    case ContactState::kLost:
      break;
  }
}

ContactSituation ContactSupervisor::situation() const noexcept {
  ContactSituation s;
  s.lost = state_ == ContactState::kLost;
  if (state_ == ContactState::kApproach) s.force_limit = options_.approach_force_N;
  s.force_added = integral_N_;
  return s;
}

void ContactSupervisor::save(BlobWriter& out) const {
  out.put(state_);
  out.put(toNs(entered_));
  out.put(toNs(doubt_));
  out.put(toNs(last_));
  out.put(integral_N_);
}

void ContactSupervisor::restore(BlobReader& in) {
  state_ = in.get<ContactState>();
  entered_ = simTimeFromNs(in.get<std::int64_t>());
  doubt_ = simTimeFromNs(in.get<std::int64_t>());
  last_ = simTimeFromNs(in.get<std::int64_t>());
  integral_N_ = in.get<double>();
}

}  // namespace ballbot
