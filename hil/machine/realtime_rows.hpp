#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/machine/machine_facts.hpp"

namespace ballbot {

/// What this process may have of the system.
struct ProcessRights {
  bool root = false;
  std::int64_t priority = 0;      ///< of SCHED_FIFO, at most; RLIMIT_RTPRIO
  std::int64_t locked_bytes = 0;  ///< RLIMIT_MEMLOCK; -1: without limit
};

/// One thing that makes a real-time loop late, or does not.
struct RealtimeRow {
  std::string name;   ///< for programs: "idle_states"
  std::string words;  ///< for people
  bool good = false;
  std::string found = {}, wanted = {};
  std::string mend = {};  ///< how to change it; "" if nothing is wrong
  std::string worth =
      {};  ///< what it is worth here; "" until somebody has measured it or said why not
  bool measured = false;
};

/// Every row, in the order in which one mends them. Pure. @param core  of the loop
std::vector<RealtimeRow> realtimeRows(const MachineFacts& facts, const ProcessRights& rights,
                                      int core);

}  // namespace ballbot
