#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/study_definition.hpp"

namespace ballbot {

/// How many of how many passed, and the 95 % interval of the rate behind it (Wilson 1927): it holds
/// the true rate in about 19 of 20 cases, also where all or none passed.
struct RateEstimate {
  int passed = 0, count = 0;
  double low = 0, high = 1;

  /// Of those that ran; meaningless where none did.
  double rate() const { return count > 0 ? static_cast<double>(passed) / count : 0; }
};
RateEstimate wilsonInterval(int passed, int count);

/// Where the rate of passing crosses a level along one axis.
struct Boundary {
  enum class Kind {
    kFound,
    kPassesEverywhere,  ///< in the range looked at
    kPassesNowhere,
    kUnknown,  ///< nothing ran where that had to be known
  };
  Kind kind = Kind::kFound;
  bool rising = true;  ///< the rate grows with the value
  double estimate = 0;
  /// 95 % interval: beyond its ends the rate is below or above the level for sure, given that it
  /// changes in one direction only. Absent: that end is outside of what was looked at.
  std::optional<double> low, high;
};

/// Bisection for the value where the rate of passing crosses a level, and for the two values beyond
/// which its interval lies wholly on one side. It asks for rates and is told them; who runs the
/// cases does not matter to it.
class BoundarySearch {
 public:
  BoundarySearch(const AxisRange& range, double rate, double resolution)
      : range_(range), rate_(rate), resolution_(resolution) {}

  /// Values whose rate is needed next; empty once the boundary is known well enough, or cannot be
  /// known because at a value that was asked for no case ran.
  std::vector<double> next() const;
  /// About how many more values will be asked for, as far as can be seen by now; for progress.
  int expectedLeft() const;
  void tell(double value, const RateEstimate& rate) {
    if (rate.count == 0) {
      stuck_ = true;
    } else {
      known_[value] = rate;
    }
  }

  /// From what was told so far.
  Boundary boundary() const;
  const std::map<double, RateEstimate>& known() const { return known_; }

 private:
  struct Bracket {
    double failing, passing;
  };
  enum class Level { kSurelyFails, kPasses, kSurelyPasses };
  bool holds(Level level, const RateEstimate& rate) const;
  int halvings(double failing, double passing) const;
  std::optional<Bracket> bracket(Level level) const;

  AxisRange range_;
  double rate_, resolution_;
  bool stuck_ = false;
  std::map<double, RateEstimate> known_;
};

/// The boundary that lies in rates known at some values, e.g. those of a grid.
Boundary boundaryIn(const std::map<double, RateEstimate>& rates, double rate);

}  // namespace ballbot
