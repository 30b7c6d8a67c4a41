#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "studies/study_definition.hpp"

namespace ballbot {

/// A robot or a law that is looked at beside others.
struct CaptureVariant {
  std::string label;
  std::vector<std::string> overrides;  ///< "path=value", as for --set

  /// Of one or more "path=value", with ';' between them; they are its label, too.
  /// @throw InputError if there is none in it.
  static CaptureVariant of(const std::string& text);
};

/// Which pushes shall be looked at, and how a push is judged.
struct CaptureRequest {
  std::string scenario;
  std::vector<std::string> overrides;    ///< for all variants
  std::vector<CaptureVariant> variants;  ///< at least one
  std::vector<double> durations_s = {0.5};
  std::vector<double> heights_m = {0.35};  ///< above the ball's centre, on the base
  int directions = 8;                      ///< from x of W towards y, evenly
  double start_s = 3;                      ///< of the push; the robot stands still by then
  double after_s = 5;                      ///< from the push's end: as long it must not fall
  int seeds = 3;
  double rate = 0.5;        ///< share of the seeds that must not fall
  double resolution_N = 2;  ///< forces are whole multiples of it
  double timeout_s = 600;

  double directionDeg(int i) const { return 360.0 * i / directions; }
};

/// The study behind it: variants, durations, heights, directions, and the force as the axis that
/// is searched, up to `up_to_N`. A case passes if the robot does not fall; the scenario's own
/// pushes and requirements are replaced.
/// @throw InputError for what cannot be a study, or if an override changes what this decides.
Study captureStudy(const CaptureRequest& request, double up_to_N);

/// Its axes, in this order.
enum CaptureAxis : std::size_t {
  kVariantAxis,
  kDurationAxis,
  kHeightAxis,
  kDirectionAxis,
  kForceAxis
};

}  // namespace ballbot
