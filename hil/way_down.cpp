#include "hil/way_down.hpp"

#include <algorithm>

namespace ballbot {

const char* toText(WayDown::Stage stage) noexcept {
  switch (stage) {
    case WayDown::Stage::kDisable:
    case WayDown::Stage::kDisableAgain:
      return "disable voltage";
    case WayDown::Stage::kQuickStop:
      return "quick stop";
    case WayDown::Stage::kNmtStop:
    case WayDown::Stage::kGivenUp:
      return "NMT stop";
  }
  return "";
}

WayDown::Said WayDown::saidBy(DriveState state) noexcept {
  switch (state) {
    case DriveState::kNotReadyToSwitchOn:
    case DriveState::kSwitchOnDisabled:
    case DriveState::kReadyToSwitchOn:
    case DriveState::kFault:
      return Said::kOff;
    case DriveState::kUnknown:
      return Said::kNothing;
    default:
      return Said::kOn;
  }
}

void WayDown::begin() noexcept {
  under_way_ = true;
  legs_ = {};
}

void WayDown::step(const std::array<Said, kDriveCount>& said) noexcept {
  for (std::size_t i = 0; i < legs_.size(); ++i) step(legs_[i], said[i]);
}

void WayDown::step(Leg& leg, Said said) const noexcept {
  leg.order = {};
  if (said == Said::kOff) {
    leg.off = true;
    return;
  }
  if (leg.off) {
    if (said == Said::kNothing) return;  // it has said so; silence takes nothing back
    leg = {};
  }
  const int limit = leg.stage == Stage::kNmtStop ? kLastStage * patience_ : patience_;
  if (leg.waited++ >= limit && leg.stage != Stage::kGivenUp) {
    leg.stage = static_cast<Stage>(static_cast<int>(leg.stage) + 1);
    leg.waited = 1;
    leg.order.nmt_stop = leg.stage == Stage::kNmtStop;
  }
  const bool stopping = leg.stage == Stage::kNmtStop;
  leg.order.nmt_pre_operational = stopping && leg.waited == 2;
  leg.order.disable_by_sdo = stopping && leg.waited == 3;
  const bool told = stopping && leg.waited >= 3 && leg.waited < 3 + patience_;  // time to answer
  leg.order.ask = said == Said::kNothing && !leg.order.nmt_stop && !told;
  if (leg.stage == Stage::kQuickStop) leg.order.goal = DriveGoal::kQuickStop;
}

bool WayDown::confirmed() const noexcept {
  return std::all_of(legs_.begin(), legs_.end(), [](const Leg& leg) { return leg.off; });
}

bool WayDown::over() const noexcept {
  return std::all_of(legs_.begin(), legs_.end(),
                     [](const Leg& leg) { return leg.off || leg.stage == Stage::kGivenUp; });
}

}  // namespace ballbot
