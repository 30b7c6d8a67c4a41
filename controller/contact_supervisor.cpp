#include "controller/contact_supervisor.hpp"

#include <algorithm>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kNoForce_N = 0.05;  // asked for: as good as none

}  // namespace

void ContactSupervision::describe(ConfigVisitor& v) {
  v.number(may("found_at_N", "measured normal force from which on something is touched"),
           found_at_N, {0.1, 1e3});
  v.duration(
      may("found_after_ms", "how long it must be measured before the contact counts as found"),
      found_after, {0, 1e5});
  v.number(may("approach_force_N", "largest force asked for before something is touched"),
           approach_force_N, {0.1, 1e3});
  v.duration(
      may("approach_limit_s", "how long an approach may last before the contact is given up"),
      approach_limit, {0.1, 1e3});
  v.number(may("lost_share",
               "share of the force asked for; while less is measured, the contact is in doubt"),
           lost_share, {0, 1});
  v.duration(may("lost_after_ms",
                 "how long the contact may be in doubt before it is lost and nothing is pushed"),
             lost_after, {1, 1e5});
  v.number(may("integral_gain_per_s",
               "rate at which the force's error is added to what is asked for; 0 adds nothing"),
           integral_gain, {0, 10});
  v.number(may("integral_limit_N", "largest force that the integral adds"), integral_limit_N,
           {0, 1e3});
}

ContactSupervision ContactSupervision::read(ConfigReader& in) {
  ContactSupervision o;
  readDescribed(in, o);
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
      integral_N_ =
          std::clamp(integral_N_ + options_.integral_gain * since_last * (asked - measured),
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

}  // namespace ballbot
