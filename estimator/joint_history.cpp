#include "estimator/joint_history.hpp"

#include <algorithm>

namespace ballbot {

void JointHistory::add(SimTime time, const JointVector& angle) noexcept {
  if (size_ > 0 && newest().time == time)
    next_ = (next_ + kCapacity - 1) % kCapacity;
  else
    size_ = std::min(size_ + 1, kCapacity);
  entries_[static_cast<std::size_t>(next_)] = {time, angle};
  next_ = (next_ + 1) % kCapacity;
}

JointVector JointHistory::at(SimTime time) const noexcept {
  if (time >= newest().time) return newest().angle;
  for (int age = 1; age < size_; ++age) {
    const Entry& before = fromNewest(age);
    if (before.time > time) continue;
    const Entry& after = fromNewest(age - 1);
    const double fraction = toSeconds(time - before.time) / toSeconds(after.time - before.time);
    return before.angle + fraction * (after.angle - before.angle);
  }
  return fromNewest(size_ - 1).angle;
}

void JointHistory::save(BlobWriter& out) const {
  out.put(size_);
  for (int age = size_ - 1; age >= 0; --age) {
    out.put(toNs(fromNewest(age).time));
    out.putDoubles(fromNewest(age).angle.data(), kJointCount);
  }
}

void JointHistory::restore(BlobReader& in) {
  const int count = in.get<int>();
  size_ = next_ = 0;
  for (int i = 0; i < count; ++i) {
    const SimTime time = simTimeFromNs(in.get<std::int64_t>());
    JointVector angle;
    in.getDoubles(angle.data(), kJointCount);
    add(time, angle);
  }
}

}  // namespace ballbot
