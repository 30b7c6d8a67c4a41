#pragma once

#include "controller/tasks.hpp"
#include "core/time.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

enum class ContactState : std::int8_t {
  kNone,      ///< no force is asked for
  kApproach,  ///< asked for, nothing touched yet
  kContact,
  kLost  ///< slipped off or never found; nothing is pushed until no force is asked for
};

struct ContactSupervision {
  double found_at_N = 1;  ///< measured for `found_after`: there is something to push against
  SimDuration found_after = std::chrono::milliseconds(100);
  double approach_force_N = 2;  ///< largest asked for before something is touched
  SimDuration approach_limit = std::chrono::seconds(4);
  double lost_share = 0.3;  ///< of the force asked for
  SimDuration lost_after = std::chrono::milliseconds(300);
  double integral_gain = 0;  ///< of the force error [1/s]
  double integral_limit_N = 2;

  void describe(ConfigVisitor& v);
  /// @throw InputError for bad keys or values.
  static ContactSupervision read(ConfigReader& in);
};

/// Decides from asked and measured contact force what plans may count on. A plan that leans on a
/// force which is not there falls: so the force is small until something is touched, and all of the
/// contact is off once the measured force has stayed below `lost_share` of what was asked. In
/// contact, an integral may add to the force asked for what the plant does not give.
class ContactSupervisor {
 public:
  explicit ContactSupervisor(const ContactSupervision& options) : options_(options) {}

  /// @param asked     normal force asked for at `now` [N]
  /// @param measured  normal force measured [N]
  void update(SimTime now, double asked, double measured) noexcept;

  ContactState state() const noexcept { return state_; }
  /// For plans from now on; the frame's turn is left to the caller.
  ContactSituation situation() const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.state_);
    visit(self.entered_);
    visit(self.doubt_);
    visit(self.last_);
    visit(self.integral_N_);
  }

 private:
  void enter(ContactState state, SimTime now) noexcept;

  ContactSupervision options_;
  ContactState state_ = ContactState::kNone;
  SimTime entered_{};  ///< when the state was entered
  SimTime doubt_{};    ///< since when the measured force speaks for leaving it, or not
  SimTime last_{};     ///< last update
  double integral_N_ = 0;
};

}  // namespace ballbot
