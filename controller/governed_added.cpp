#include "controller/governed_added.hpp"

namespace ballbot {
namespace {

Matrix3 rotation(const Vector3& angles) {
  return rotationFromYawPitchRoll(angles[0], angles[1], angles[2]);
}

}  // namespace

Vector3 GovernedAdded::reference(const Vector3& asked, double ahead) const noexcept {
  switch (kind) {
    case CommandKind::kFree:
      return asked;
    case CommandKind::kPlace:
      return place.reference(asked, ahead);
    case CommandKind::kOrientation:
      break;
  }
  return yawPitchRollFromRotation(orientation.reference(rotation(asked), ahead));
}

bool GovernedAdded::cuts(const Vector3& asked) const noexcept {
  if (kind == CommandKind::kPlace) return place.cuts(asked);
  return kind == CommandKind::kOrientation && orientation.cuts(rotation(asked));
}

void GovernedAdded::start(const Vector3& asked) noexcept {
  place.anchor = asked;
  if (kind == CommandKind::kOrientation) orientation.anchor = rotation(asked);
}

void GovernedAdded::follow(const Vector3& asked, double seconds, const Vector3& robot, double lag,
                           double angle_lag) noexcept {
  if (kind == CommandKind::kPlace) place.follow(asked, seconds, robot, lag);
  if (kind == CommandKind::kOrientation) {
    orientation.follow(rotation(asked), seconds, rotation(robot), angle_lag);
  }
}

}  // namespace ballbot
