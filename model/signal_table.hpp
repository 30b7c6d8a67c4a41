#pragma once

#include <vector>

#include "model/external_forces.hpp"
#include "model/reports.hpp"
#include "model/signal.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Every quantity of the frames, in the order of the messages. The time a frame holds for is
/// not among them: whoever exchanges frames knows it.
const std::vector<Signal<ActuatorCommand>>& commandSignals();
/// In no message: forces come from whoever imports the plant. Their message_field is empty.
const std::vector<Signal<ExternalForces>>& externalForceSignals();
const std::vector<Signal<SensorFrame>>& sensorSignals();
const std::vector<Signal<TruthFrame>>& truthSignals();
const std::vector<Signal<EstimateFrame>>& estimateSignals();
const std::vector<Signal<PlanFrame>>& planSignals();

/// The same by the frame's type, for what is written once for all frames.
inline const auto& signalsOf(const ActuatorCommand&) { return commandSignals(); }
inline const auto& signalsOf(const SensorFrame&) { return sensorSignals(); }
inline const auto& signalsOf(const TruthFrame&) { return truthSignals(); }
inline const auto& signalsOf(const EstimateFrame&) { return estimateSignals(); }
inline const auto& signalsOf(const PlanFrame&) { return planSignals(); }

}  // namespace ballbot
