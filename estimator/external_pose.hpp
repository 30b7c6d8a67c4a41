#pragma once

#include <array>
#include <optional>

#include "core/time.hpp"
#include "estimator/filter_state.hpp"

namespace ballbot {

struct ExternalPoseSettings {
  double position_sigma_m = 0.005;
  double yaw_sigma_rad = 0.01;
  /// Chi-square (3) above which a pose is refused, until ten in a row were.
  double chi_square_limit = 30;
};

/// Where ball and yaw were at the last 128 updates, 0.3 s at 400 Hz, as the filter sees them now.
class PoseHistory {
 public:
  struct Entry {
    SimTime time{};
    Eigen::Vector2d p_WK_W = Eigen::Vector2d::Zero();  ///< [m]
    double yaw = 0;                                    ///< continuous [rad]
  };

  void add(const Entry& entry) noexcept;
  /// Linear in between; nothing before the oldest or after the newest entry.
  std::optional<Entry> at(SimTime time) const noexcept;
  /// The filter learned that it stands at `now` rather than where its newest entry says: all
  /// entries move along as one rigid body.
  void moveTo(const Entry& now) noexcept;

  void save(BlobWriter& out) const;
  void restore(BlobReader& in);

 private:
  static constexpr int kCapacity = 128;
  const Entry& fromNewest(int age) const noexcept {
    return entries_[static_cast<std::size_t>((next_ + 2 * kCapacity - 1 - age) % kCapacity)];
  }
  std::array<Entry, kCapacity> entries_;
  int next_ = 0;
  int size_ = 0;
};

/// A pose of some time ago as a measurement of the present state: position and yaw then are those
/// of now less what odometry says was covered since, which turns with the yaw error. Rows of unit
/// variance: 0 = y + H dx.
struct PoseRows {
  Eigen::Matrix<double, 3, kTangentDim> H = Eigen::Matrix<double, 3, kTangentDim>::Zero();
  Vector3 y = Vector3::Zero();
  /// y' S^-1 y, S the covariance of y that the state's covariance predicts.
  double chiSquare(const TangentMatrix& covariance) const noexcept;
};

/// @param then, now  history at the time of the pose and newest, @param pose_W x, y [m], yaw [rad]
PoseRows poseRows(const FilterState& x, const PoseHistory::Entry& then,
                  const PoseHistory::Entry& now, const Vector3& pose_W,
                  const ExternalPoseSettings& settings) noexcept;

}  // namespace ballbot
