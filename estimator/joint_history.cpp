#include "estimator/joint_history.hpp"

namespace ballbot {

void JointHistory::add(SimTime time, const JointVector& angle) noexcept {
  if (!empty() && newestTime() == time) {
    entries_.fromNewest(0).angle = angle;
  } else {
    entries_.add({time, angle});
  }
}

JointVector JointHistory::at(SimTime time) const noexcept {
  if (time >= newestTime()) return entries_.fromNewest(0).angle;
  for (int age = 1; age < entries_.size(); ++age) {
    const Entry& before = entries_.fromNewest(age);
    if (before.time > time) continue;
    const Entry& after = entries_.fromNewest(age - 1);
    const double fraction = toSeconds(time - before.time) / toSeconds(after.time - before.time);
    return before.angle + fraction * (after.angle - before.angle);
  }
  return entries_.fromNewest(entries_.size() - 1).angle;
}

}  // namespace ballbot
