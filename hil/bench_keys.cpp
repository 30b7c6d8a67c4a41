// What a bench file says of buses, drives, IMU and safety: its keys.
#include <cmath>
#include <filesystem>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "hil/bench_config.hpp"

namespace ballbot {
namespace {

/// The data sheet that `eds` names, relative to the file in which it stands.
void describeDataSheet(ConfigVisitor& v, NamedDataSheet& out) {
  v.other(may("eds", "what its vendor says: compared with all of this before a bus is touched"),
          "EDS or DCF file, beside the one that names it", [&](ConfigReader& in) {
            const std::filesystem::path file = in.text("eds");
            const SourceLocation where = in.raw("eds")->where();
            const auto beside = std::filesystem::path(where.source).parent_path() / file;
            out.sheet = std::make_shared<const DataSheet>(
                DataSheet::read(file.is_absolute() ? file.string() : beside.string()));
            out.where = toText(where);
          });
}

void describeScaling(ConfigVisitor& v, DriveScaling& s) {
  v.number(may("rated_torque_Nm", "of 1000 counts of torque"), s.torque_reference, {0.001, 1000});
  v.number(may("motor_torque_at_rated_current_Nm",
               "behind the gear, of 1000 counts of 6078; 0: the rated torque"),
           s.motor_torque_reference, {0, 1000});
  v.number(may("encoder_counts_per_turn", "of 6064, per turn of the joint"), s.encoder_counts,
           {16, 1e9});
  v.number(may("motor_encoder_counts_per_turn", "of 60E4:01, per turn of the joint"),
           s.motor_encoder_counts, {16, 1e9});
  v.number(may("velocity_unit_rad_per_s",
               "of one count of 606C; where nothing is said, a count of 6064 per second"),
           s.velocity_unit, {1e-9, 10});
  v.number(may("sign", "1 or -1: of the drive's angles and torques against the joint's"), s.sign,
           {-1, 1});
  v.check([&](const ConfigReader& in) {
    if (std::abs(s.sign) != 1) throw InputError(in.at("sign") + " must be 1 or -1");
  });
  v.number(may("offset_deg", "joint angle at which 6064 is zero"), s.offset, {-3600, 3600},
           kRadPerDeg);
  v.number(may("spring_stiffness_Nm_per_rad",
               "of the joint's spring: gives the motor's side where 60E4 is not mapped"),
           s.spring_stiffness, {1, 1e6});
}

void describeLimits(ConfigVisitor& v, DriveLimits& l) {
  v.number(may("torque_limit_Nm", "what is sent is cut to it"), l.torque, {kTiny, 1000});
  v.number(may("torque_rate_limit_Nm_per_s", "likewise"), l.torque_rate, {kTiny, 1e6});
  v.number(may("velocity_limit_rad_per_s", "beyond it the bench stops"), l.velocity, {kTiny, 1000});
  v.number(may("position_low_deg", "below it the bench stops"), l.position_low, {}, kRadPerDeg);
  v.number(may("position_high_deg", "above it the bench stops"), l.position_high, {}, kRadPerDeg);
}

}  // namespace

void BusConfig::describe(ConfigVisitor& v) {
  v.text(must("address", "slcan:/dev/ttyACM0 or socketcan:can0"), address);
  v.integer(may("bitrate_kbps", "of the bus"), settings.bitrate_kbps, {10, 1000});
  v.boolean(may("acknowledges", "whether the slcan adapter answers commands"),
            settings.acknowledges);
  v.section(may("fd", "makes it CAN FD with bit-rate switching"), [&](ConfigVisitor& fd) {
    fd.integer(must("data_bitrate_kbps", "of a frame's data, not below bitrate_kbps"),
               settings.data_bitrate_kbps, {1000, 8000});
  });
  v.check([&](const ConfigReader& in) {
    if (settings.flexible() && settings.data_bitrate_kbps < settings.bitrate_kbps) {
      throw InputError(in.at("fd") + " data_bitrate_kbps must not be below bitrate_kbps");
    }
  });
}

void DriveConfig::describe(ConfigVisitor& v) {
  describeDataSheet(v, data_sheet);
  v.other(may("torque_reference_object",
              "the object that says, in mNm, what torque 1000 counts are; 6076:00, or a vendor's"),
          "index and sub-index, as in 2031:00", [&](ConfigReader& in) {
            try {
              torque_reference_object = readObjectAddress(in.text("torque_reference_object"));
            } catch (const InputError& e) {
              throw InputError(in.at("torque_reference_object") + ": " + e.what());
            }
          });
  v.integer(may("quick_stop_option", "605A, what the drive does at a quick stop"),
            quick_stop_option, {0, 8});
  v.integer(may("fault_reaction_option", "605E, what it does at a fault"), fault_reaction_option,
            {0, 4});
  // 0, no action, would let a drive go on without its master.
  v.integer(may("abort_connection_option",
                "6007, what it does without its master: 1 fault, 2 disable voltage, 3 quick stop"),
            abort_connection_option, {1, 3});
  describeScaling(v, scaling);
  describeLimits(v, limits);
  v.number(may("stiffness_Nm_per_rad", "of the drive's position loop, in drive_mode position"),
           stiffness, {0, 1e4});
  v.number(may("damping_Nms_per_rad", "likewise"), damping, {0, 1e3});
  v.number(may("torque_frequency_Hz",
               "natural frequency of its response to a torque, as `ballbot identify` finds it"),
           torque_frequency_Hz, {1, 5000});
  v.number(may("torque_damping_ratio", "of that response"), torque_damping_ratio, {0.1, 10});
  v.number(may("torque_delay_ms", "of that response"), torque_delay, {0, 100}, 1e-3);
  v.text(may("off_switch", "what a person pulls to take its power"), off_switch);
}

void ImuConfig::describe(ConfigVisitor& v, SimDuration cycle, double last_bus) {
  describeDataSheet(v, data_sheet);
  SimDuration period = cycle;
  v.duration(may("period_us", "from sample to sample, where it is slower than the bus"), period,
             {1, 1e5});
  period_cycles = static_cast<int>((period + cycle - SimDuration{1}) / cycle);
  v.integer(may("bus", "on which it is: 0, or 1"), bus, v.depending({0, last_bus}));
  v.integer(may("node", "its CANopen node"), node, {1, 126});
  v.number(may("accel_resolution_m_per_s2", "of one count"), accel_resolution, {1e-6, 1});
  v.number(may("gyro_resolution_rad_per_s", "of one count"), gyro_resolution, {1e-7, 1});
}

void SafetyConfig::describe(ConfigVisitor& v, SimDuration cycle) {
  const auto cycles = [&](const char* key, const char* words, int& count) {
    SimDuration t = count * cycle;
    v.duration(may(key, words), t, {0, 1e5});
    count = static_cast<int>((t + cycle - SimDuration{1}) / cycle);
  };
  cycles("command_watchdog_ms", "without a new command", watchdog_cycles);
  cycles("damping_ms", "of bounded damping, then torque off", damping_cycles);
  cycles("ramp_ms", "in which torque grows from zero after engaging", ramp_cycles);
  cycles("heartbeat_timeout_ms", "a node's heartbeat missing", heartbeat_cycles);
  cycles("transition_timeout_ms", "for a drive to confirm a transition", transition_cycles);
  cycles("confirm_off_ms", "for a drive to say that its torque is off, a cycle or more",
         confirm_cycles);
  v.check([this](const ConfigReader& in) {
    if (confirm_cycles < 1) throw InputError(in.at("confirm_off_ms") + " must be a cycle or more");
  });
  v.integer(may("stale_cycles", "a drive's or the IMU's frames missing"), stale_cycles, {1, 100});
  v.integer(may("late_cycles", "periods in a row that the loop skips"), late_cycles, {1, 100});
  v.number(may("damping_Nms_per_rad", "with which drives brake on the way down"), damping,
           {0, 100});
  v.number(may("damping_torque_Nm", "at most, likewise"), damping_torque, {0, 100});
  v.number(may("rest_velocity_rad_per_s", "torque comes on only below it"), rest_velocity,
           {kTiny, 1});
  v.number(may("tilt_limit_deg", "beyond it the bench stops"), tilt, {1, 90}, kRadPerDeg);
  v.number(may("encoder_mismatch_rad", "position against integrated velocity"), encoder_mismatch,
           {1e-4, 10});
  describeDoubts(v);
}

void SafetyConfig::describeDoubts(ConfigVisitor& v) {
  v.number(may("position_jump_rad", "in one step, beyond what the velocity says"), position_jump,
           {1e-4, 10});
  v.number(may("spring_mismatch_rad", "between motor angle, joint angle and torque"),
           spring_mismatch, {1e-5, 10});
  v.number(may("torque_mismatch_Nm", "felt against expected torque"), torque_mismatch,
           {1e-3, 1000});
  v.number(may("torque_mismatch_share", "and this share of the torque asked for or expected"),
           torque_mismatch_share, {0, 1});
  v.integer(may("torque_mismatch_cycles", "how long it has to last"), torque_mismatch_cycles,
            {1, 1000});
  v.integer(may("doubt_cycles", "likewise for what is exact: spring, torque demand"), doubt_cycles,
            {1, 1000});
  v.integer(may("most_misses", "cycles of the last 32 without a drive's PDOs"), most_misses,
            {1, 33});
  v.integer(may("torque_repeats", "cycles of one torque bit for bit while it should move; 0: any"),
            torque_repeats, {0, 1000});
  v.integer(may("imu_repeats", "samples equal bit for bit; 0: as many as there are"), imu_repeats,
            {0, 1000});
  v.integer(may("read_back_cycles", "from one parameter read to the next; 0: none is read"),
            read_back_cycles, {0, 100'000});
  v.integer(may("command_repeats", "commands equal bit for bit; 0: as many as there are"),
            command_repeats, {0, 1e6});
}

void RealtimeConfig::describe(ConfigVisitor& v, SimDuration cycle) {
  v.integer(may("priority", "of the loop, SCHED_FIFO"), priority, {1, 98});
  v.duration(may("collect_us", "after SYNC: the drives' answers are awaited so long"), collect,
             {10, 1e5});
  v.duration(may("act_us", "after SYNC: the command goes out"), act, {10, 1e5});
  v.check([this, cycle](const ConfigReader& in) {
    if (collect < act && act < cycle) return;
    throw InputError(in.at("act_us") + " must lie between collect_us and the cycle");
  });
}

void CommissioningConfig::describe(ConfigVisitor& v) {
  v.numbers(may("arm_pose_deg", "joint angles at the arm's marks"), arm_pose.data(),
            arm_pose.size(), {-360, 360}, kRadPerDeg);
  v.number(may("torque_share", "of each drive's torque limit, to and fro"), torque_share,
           {0.02, 0.5});
}

}  // namespace ballbot
