#pragma once

#include <optional>

#include "core/time.hpp"
#include "estimator/filter_state.hpp"
#include "estimator/last_values.hpp"

namespace ballbot {

class ConfigVisitor;

/// So many poses in a row against what is believed are right: it has drifted away unnoticed.
constexpr int kPosesUntilBelieved = 10;

struct ExternalPoseSettings {
  double position_sigma_m = 0.005;
  double yaw_sigma_rad = 0.01;
  /// Chi-square (3) above which a pose is refused, until ten in a row were.
  double chi_square_limit = 30;

  void describe(ConfigVisitor& v);
};

/// Where the robot stands while it is held, as the mean of the poses of that time. A pose far from
/// the mean is refused; ten in a row are believed, and the mean begins anew with the last of them.
/// Free of allocation; may run in the control step.
class RestPose {
 public:
  /// @return false where the pose was refused
  bool add(const Vector3& pose_W, const ExternalPoseSettings& settings) noexcept;

  std::int64_t samples() const { return samples_; }
  /// Ball centre x, y [m] and yaw, within half a turn of zero [rad]; zero before the first pose.
  Vector3 mean() const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.samples_);
    visit(self.refused_);
    visit(self.mean_);
  }

 private:
  std::int64_t samples_ = 0;
  int refused_ = 0;                 ///< in a row
  Vector3 mean_ = Vector3::Zero();  ///< its yaw follows the first pose's, not wrapped
};

/// Where ball and yaw were at the last 128 updates, 0.3 s at 400 Hz, as the filter sees them now.
class PoseHistory {
 public:
  struct Entry {
    SimTime time{};
    Eigen::Vector2d p_WK_W = Eigen::Vector2d::Zero();  ///< [m]
    double yaw = 0;                                    ///< continuous [rad]

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.time);
      visit(self.p_WK_W);
      visit(self.yaw);
    }
  };

  void add(const Entry& entry) noexcept { entries_.add(entry); }
  /// Linear in between; nothing before the oldest or after the newest entry.
  std::optional<Entry> at(SimTime time) const noexcept;
  /// The filter learned that it stands at `now` rather than where its newest entry says: all
  /// entries move along as one rigid body.
  void moveTo(const Entry& now) noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.entries_);
  }

 private:
  LastValues<Entry, 128> entries_;
};

/// A pose of some time ago as a measurement of the present state: position and yaw then are those
/// of now less what odometry says was covered since, which turns with the yaw error. Rows of unit
/// variance: 0 = y + H dx.
struct PoseRows {
  Eigen::Matrix<double, 3, kTangentDim> H = Eigen::Matrix<double, 3, kTangentDim>::Zero();
  Vector3 y = Vector3::Zero();
  /// y' S^-1 y, S the covariance of y that the state's covariance predicts.
  double chiSquare(const TangentMatrix& covariance) const noexcept;
  /// By how much the state has to turn about the vertical for its yaw to lie between that of the
  /// pose and its own, each counting as it is known [rad].
  double yawCorrection(const TangentMatrix& covariance,
                       const ExternalPoseSettings& settings) const noexcept;
};

/// @param then, now  history at the time of the pose and newest, @param pose_W x, y [m], yaw [rad]
PoseRows poseRows(const FilterState& x, const PoseHistory::Entry& then,
                  const PoseHistory::Entry& now, const Vector3& pose_W,
                  const ExternalPoseSettings& settings) noexcept;

}  // namespace ballbot
