#pragma once

#include "controller/control_law.hpp"
#include "core/state_blob.hpp"

namespace ballbot {

inline void putPolicySample(BlobWriter& out, const PolicySample& p) {
  out.putDoubles(p.x.data(), p.x.size());
  out.putDoubles(p.torque.data(), p.torque.size());
  out.putDoubles(p.feedback.data(), p.feedback.size());
  out.putDoubles(p.joint_position.data(), p.joint_position.size());
  out.putDoubles(p.joint_velocity.data(), p.joint_velocity.size());
}

inline void getPolicySample(BlobReader& in, PolicySample& p) {
  in.getDoubles(p.x.data(), p.x.size());
  in.getDoubles(p.torque.data(), p.torque.size());
  in.getDoubles(p.feedback.data(), p.feedback.size());
  in.getDoubles(p.joint_position.data(), p.joint_position.size());
  in.getDoubles(p.joint_velocity.data(), p.joint_velocity.size());
}

}  // namespace ballbot
