#include "hil/rehearsal/commissioning_trial.hpp"

#include <utility>

#include "core/angle.hpp"
#include "hil/rehearsal/emulated_person.hpp"
#include "hil/rehearsal/wire_faults.hpp"

namespace ballbot {
namespace {

constexpr std::uint32_t kSync = 0x080;

/// Whole nodes exchanged, as by their node switches or plugs: all that either says and is told.
void exchangeNodes(EmulatorConfig& e, std::size_t a, std::size_t b) {
  std::swap(e.drives[a].node, e.drives[b].node);
  std::swap(e.drive_bus[a], e.drive_bus[b]);
}

CommissioningCase inDrives(const char* name, const char* found_by,
                           std::function<void(EmulatorConfig&)> change) {
  return {name, found_by, std::move(change), {}};
}

/// A change of both frames of the IMU; each holds three numbers of 16 bits.
CommissioningCase inImu(const char* name, const char* found_by, const FrameChange& accel,
                        const FrameChange& gyro) {
  return {name, found_by, {}, [=](Rehearsal& r) {
            if (accel) changeToMaster(r, 0, imuPdo(1), accel);
            if (gyro) changeToMaster(r, 0, imuPdo(2), gyro);
          }};
}

FrameChange exchange(int a, int b) {
  return [=](CanFrame& f) {
    for (int k = 0; k < 2; ++k) {
      std::swap(f.data[static_cast<std::size_t>(2 * a + k)],
                f.data[static_cast<std::size_t>(2 * b + k)]);
    }
  };
}

FrameChange inTurn(FrameChange first, FrameChange second) {
  return [=](CanFrame& f) {
    first(f);
    second(f);
  };
}

FrameChange negateAxis(int axis) { return negate(2 * axis, 2); }

/// Torque with the wrong sign on its way in and out: what is asked and what is said agree.
void reverseTorque(Rehearsal& r) {
  changeToDrives(r, 0, rpdoOf(1, 1), negate(2, 2));
  changeToMaster(r, 0, tpdoOf(1, 1), negate(2, 2));
  changeToMaster(r, 0, tpdoOf(1, 3), negate(0, 2));
}

}  // namespace

std::vector<CommissioningCase> commissioningCases() {
  const FrameChange none;
  return {
      {"nothing is wrong", "", {}, {}},
      inDrives("two wheels exchanged, in and out", "turn wheel 1",
               [](EmulatorConfig& e) { exchangeNodes(e, 0, 1); }),
      inDrives("a wheel and an arm joint exchanged", "turn wheel 3",
               [](EmulatorConfig& e) { exchangeNodes(e, 2, 3); }),
      inDrives("two arm joints exchanged", "turn arm 2",
               [](EmulatorConfig& e) { exchangeNodes(e, 4, 5); }),
      inDrives("a wheel's sign, of angle and torque", "turn wheel 2",
               [](EmulatorConfig& e) { e.drives[1].sign = -1; }),
      inDrives("an arm joint's sign, of angle and torque", "turn arm 3",
               [](EmulatorConfig& e) { e.drives[5].sign = -1; }),
      inDrives("an arm joint's zero off by 10 degrees", "stand still",
               [](EmulatorConfig& e) { e.drives[4].offset = 10 * kRadPerDeg; }),
      {"both encoders count twice as much as they say",
       "turn wheel 1",
       {},
       [](Rehearsal& r) {
         const auto doubled = [](int begin) {
           return [begin](CanFrame& f) {
             std::uint32_t v = 0;
             for (int k = 3; k >= 0; --k) v = v << 8 | f.data[static_cast<std::size_t>(begin + k)];
             v *= 2;
             for (int k = 0; k < 4; ++k, v >>= 8) {
               f.data[static_cast<std::size_t>(begin + k)] = static_cast<std::uint8_t>(v);
             }
           };
         };
         changeToMaster(r, 0, tpdoOf(0, 1), doubled(4));
         changeToMaster(r, 0, tpdoOf(0, 2), inTurn(doubled(0), doubled(4)));
       }},
      {"torque's sign, asked and said alike", "torque on wheel 2", {}, reverseTorque},
      inDrives("a drive's torque ten per cent of what it says", "torque on wheel 3",
               [](EmulatorConfig& e) { e.drives[2].torque_share = 0.1; }),
      inImu("IMU: x and y exchanged", "tilt to the right", exchange(0, 1), exchange(0, 1)),
      inImu("IMU: turned by 90 degrees about z", "tilt to the right",
            inTurn(exchange(0, 1), negateAxis(0)), inTurn(exchange(0, 1), negateAxis(0))),
      inImu("IMU: x and y backwards", "tilt to the right", inTurn(negateAxis(0), negateAxis(1)),
            inTurn(negateAxis(0), negateAxis(1))),
      inImu("IMU: upside down", "stand still", inTurn(negateAxis(1), negateAxis(2)),
            inTurn(negateAxis(1), negateAxis(2))),
      inImu("IMU: gyroscope's y backwards", "tilt forwards", none, negateAxis(1)),
      inImu("IMU: gyroscope's z backwards", "turn to the left", none, negateAxis(2)),
      inImu("IMU: accelerometer's x backwards", "tilt forwards", negateAxis(0), none),
      inImu("IMU: accelerometer's y backwards", "tilt to the right", negateAxis(1), none),
  };
}

CommissioningReport rehearseCommissioning(const CommissioningCase& wrong, RunnerKind kind,
                                          CommissioningPerson* listener) {
  const BenchConfig config = Rehearsal::defaultConfig();
  Rehearsal rehearsal(config, kind, wrong.emulator);
  EmulatedPerson person(rehearsal.rig(), config.cycleSeconds(), listener);
  rehearsal.drives().letRobotMove();
  rehearsal.wire(0).beforeSend([&](const CanFrame& f) {
    if (f.id != kSync) return;
    rehearsal.torque().onCycleEnd();
    person.onCycle();
  });
  if (wrong.wire) wrong.wire(rehearsal);
  return commission(rehearsal.runner(), person);
}

std::string foundBy(const CommissioningReport& report) {
  for (const CommissioningRow& row : report.rows) {
    if (!row.good) return row.name;
  }
  return "";
}

}  // namespace ballbot
