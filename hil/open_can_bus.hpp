#pragma once

#include <memory>
#include <string>

#include "hil/can_bus.hpp"

namespace ballbot {

/// The bus a configuration names: "slcan:/dev/ttyACM0" or "socketcan:can0".
/// @throw InputError for another kind, or if it cannot be opened.
std::unique_ptr<CanBus> openCanBus(const std::string& address, const CanBusSettings& settings = {});

}  // namespace ballbot
