#pragma once

#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/identify/record.hpp"

namespace ballbot {

/// How a drive is excited.
struct ExcitationPlan {
  int drive = 0;
  double amplitude_Nm = 3.8;         ///< the most that is asked for; large against dry friction
  double low_Hz = 2, high_Hz = 120;  ///< of the torque response
  int lines = 24;                    ///< its frequencies, evenly spread in the logarithm
  double record_s = 2;               ///< one period of a blocked excitation
  int records = 3;                   ///< periods of each; the first settles and is thrown away
  double travel_rad = 1;             ///< of the free output
};

/// One excitation: a torque, or an angle that a soft position loop follows.
struct Excitation {
  std::string name;
  bool held_out = false;
  bool needs_current = false;  ///< left out where the drive does not show its motor's
  int repeats = 0;             ///< samples after which it repeats; 0: it does not
  int settle = 0;              ///< samples at its beginning that are not recorded
  bool is_angle = false;       ///< of `value`: from where the joint is [rad], else torque [N m]
  std::vector<double> value;   ///< one a cycle
};

/// What is done in a posture, one after the other in one session of the bench:
/// blocked      two multisines over the whole band for the torque response, one of few low
///              frequencies and high rotor speeds for spring, rotor and backlash
/// free         swings in both directions at many speeds
/// back-driven  a slow torque through both signs while the output is turned
/// Each has one more excitation of other phases or frequencies that is held out.
/// @throw InputError if the plan exceeds the drive's torque limit or half the bus rate.
std::vector<Excitation> excitationsFor(Posture posture, const ExcitationPlan& plan,
                                       const BenchConfig& bench);

/// How long that takes [s].
double secondsOf(Posture posture, const ExcitationPlan& plan, const BenchConfig& bench);

/// Whole periods per record between two frequencies, evenly spread in the logarithm, none twice.
std::vector<int> linesBetween(double low_Hz, double high_Hz, int lines, double record_s);

/// Signals of the same lines: what friction and backlash do to a response differs between them.
enum class Phases {
  kSchroeder,  ///< after Schroeder (1970), so that the peak stays low
  kMirrored,   ///< their opposite
  kScattered,  ///< neither, with a higher peak
};

/// One record of a sum of sines with unit peak.
/// @param corner  line from which on amplitudes fall with frequency: what is asked of the motor
///                grows with it
std::vector<double> multisine(const std::vector<int>& lines, int length, double corner,
                              Phases phases);

}  // namespace ballbot
