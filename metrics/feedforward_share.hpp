#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/state.hpp"

namespace ballbot {

/// How much of the torques was planned and how much feedback had to add (Minniti et al. 2019,
/// alpha):
///
///   alpha = 100 |tau_ff| / (|tau_ff| + |tau_fb|),
///
/// averaged over the samples of a joint in which the sum exceeds kLeastTorque. Feedback is all that
/// is not the plan's feedforward: the plan's own K (x - x_ff) and the joints' PD.
class FeedforwardShare {
 public:
  static constexpr double kLeastTorque = 0.05;  ///< below, the share is that of noise [N m]

  void add(const JointVector& feedforward, const JointVector& feedback) noexcept;

  /// feedforward_share_wheels_percent (all three together), feedforward_share_arm1_percent, ...;
  /// absent where no sample counted.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.sum_);
    visit(self.count_);
  }

 private:
  JointVector sum_ = JointVector::Zero(), count_ = JointVector::Zero();
};

}  // namespace ballbot
