#include "hil/rehearsal/rehearsal.hpp"

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "hil/bring_up.hpp"
#include "hil/emulator/joint_rig.hpp"

namespace ballbot {
namespace {

EmulatorConfig emulatorFor(const BenchConfig& config) {
  EmulatorConfig e;
  e.cycle = config.cycle;
  e.stepped = true;
  e.bus_count = static_cast<int>(config.buses.size());
  for (std::size_t i = 0; i < e.drives.size(); ++i) {
    e.drives[i].node = config.drives[i].node;
    e.drive_bus[i] = config.drives[i].bus;
  }
  e.imu_bus = config.imu.bus;
  e.imu_node = config.imu.node;
  return e;
}

std::vector<std::unique_ptr<EmulatedBus>> makeBuses(EmulatedBench& drives, std::size_t count) {
  std::vector<std::unique_ptr<EmulatedBus>> buses;
  for (std::size_t i = 0; i < count; ++i) {
    buses.push_back(std::make_unique<EmulatedBus>(drives, static_cast<int>(i)));
  }
  return buses;
}

std::vector<CanBus*> endsOf(const std::vector<std::unique_ptr<EmulatedBus>>& buses) {
  std::vector<CanBus*> ends;
  for (const auto& bus : buses) ends.push_back(bus.get());
  return ends;
}

}  // namespace

BenchConfig Rehearsal::defaultConfig() {
  return readBenchConfig(
      parseYaml("{stepped: true, buses: [{address: none}, {address: none}], drives: [{node: 1}, "
                "{node: 2}, {node: 3}, {node: 4, bus: 1}, {node: 5, bus: 1}, {node: 6, bus: 1}]}",
                "rehearsal"));
}

Rehearsal::Rehearsal(const BenchConfig& config)
    : config_(config),
      drives_(emulatorFor(config), std::make_unique<JointRig>(JointRigOptions{})),
      bench_(config),
      buses_(makeBuses(drives_, config.buses.size())),
      io_(bench_.master(), endsOf(buses_)) {
  drives_.powerOn();
}

bool Rehearsal::engage() {
  try {
    bringUp(bench_, io_, std::chrono::nanoseconds(0));
  } catch (const LostParticipantError&) {
    bench_.observe();
    return false;
  }
  wishes_.prepare = wishes_.engage = true;
  for (int i = 0; i < 3 * config_.safety.transition_cycles; ++i) {
    cycle({});
    if (bench_.safety().action() == SafetyAction::kFollow) return true;
  }
  return false;
}

void Rehearsal::cycle(const BenchCommand& command) {
  bench_.master().beginCycle();
  io_.send();
  io_.collect(std::chrono::steady_clock::now());
  bench_.master().endCycle();
  bench_.observe();
  wishes_.command = &command;
  wishes_.bus_down = !io_.allUp();
  bench_.actuate(wishes_);
  io_.send();
}

void Rehearsal::pullBus1() {
  buses_[1]->pull();
  drives_.inject({0, EmulatedFault::kFrozenBus, 3, 0});
}

void Rehearsal::cycleWithoutMaster() {
  for (int b = 0; b < static_cast<int>(buses_.size()); ++b) {
    drives_.onFrame(b, CanFrame{0x080, false, false, 0, {}});
    drives_.outbox(b).clear();
  }
}

}  // namespace ballbot
