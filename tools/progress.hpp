#pragma once

#include <chrono>
#include <string>

namespace ballbot {

/// Progress of long work on stderr: redrawn in place on a terminal, one line per tenth in a file,
/// nothing when silent. Shows the time left from the pace so far.
class Progress {
 public:
  Progress(std::string label, bool silent);
  ~Progress();
  /// `fraction` in [0, 1]; `note` is short, e.g. "t = 3.2 s".
  void update(double fraction, const std::string& note);
  /// Ends the line.
  void finish();

 private:
  std::string label_;
  bool silent_, terminal_, open_line_ = false;
  int last_tenth_ = 0;
  std::chrono::steady_clock::time_point start_, last_draw_;
};

}  // namespace ballbot
