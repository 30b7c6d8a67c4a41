#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hil/can_bus.hpp"
#include "hil/emulator/emulated_bench.hpp"

namespace ballbot {

/// Opens the emulated bench's ends of its buses: a pty with a link for every plain path, a kernel
/// interface for socketcan:NAME. @throw InputError, OutputError.
std::vector<std::unique_ptr<CanBus>> openEmulatedBuses(
    const EmulatorConfig& config,
    const std::function<std::unique_ptr<CanBus>(const std::string&)>& open_socketcan);

/// Runs the emulated bench until `stop` is set.
void serveDrives(EmulatedBench& bench, const EmulatorConfig& config,
                 const std::vector<std::unique_ptr<CanBus>>& buses, const std::atomic<bool>* stop);

}  // namespace ballbot
