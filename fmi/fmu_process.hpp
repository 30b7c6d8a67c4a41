#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "fmi/stepped_model.hpp"

namespace ballbot {

/// The verb under which this program is the process of an FMU; nobody types it.
constexpr const char* kFmuServeVerb = "fmu-serve";

/// What of an FMU is used, and how it is set up.
struct FmuUse {
  std::string name;  ///< of the instance, for messages
  std::string file;
  std::vector<std::string> inputs, outputs;  ///< ports, in the order their values go in and out
  std::map<std::string, double> parameters;  ///< set before initialisation
  /// Port with the two halves of a hash of the FMU's state; empty where there is none.
  std::string digest;
  bool saves_state = false, variable_steps = false;  ///< what it says it can
  std::chrono::milliseconds patience{10'000};        ///< with one call
};

/// An FMU in a process of its own (this program, as `ballbot fmu-serve`), so that its crash, its
/// exit() or its hang is an error in words here and nothing worse. One request at a time over a
/// socket pair; the child goes when its parent goes.
///
/// All calls throw LostParticipantError if the process ends or does not answer in time, and what
/// FmuSlave throws.
class FmuProcess final : public SteppedModel {
 public:
  /// @param program executable of this program
  /// @throw InputError if the FMU has no such ports, needs a tool, or cannot be loaded.
  explicit FmuProcess(FmuUse use, const std::string& program = "/proc/self/exe");
  ~FmuProcess() override;
  FmuProcess(const FmuProcess&) = delete;
  FmuProcess& operator=(const FmuProcess&) = delete;

  pid_t pid() const { return pid_; }
  std::string name() const override { return use_.name; }
  /// One request for both ends of it: parameters, then initialisation at `start`. outputs() are
  /// valid after it.
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  void evaluate(const std::vector<double>& inputs) override;
  /// @throw InputError also if the FMU takes steps of one size only and this is another.
  void doStep(SimTime now, SimDuration step, const std::vector<double>& inputs) override;
  void terminate() override;
  void reset() override;
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  /// Values of the output ports, one after the other.
  const std::vector<double>& outputs() const override { return outputs_; }
  std::uint64_t stateDigest() const override;

 private:
  void start(const std::string& program);
  void open();
  void end();
  // What answers bring is no state of this end: to save is to ask.
  StateBlob ask(const BlobWriter& request, const char* what) const;
  [[noreturn]] void lost(const std::string& how) const;

  FmuUse use_;
  mutable pid_t pid_ = -1;
  int socket_ = -1;
  SimDuration only_step_{};  ///< of an FMU that takes steps of one size; zero before the first
  mutable std::vector<double> outputs_;
  mutable std::uint64_t digest_ = 0;
};

/// The child's end: serves the FMU over an open socket until the other end closes it. Returns the
/// exit code of the process.
int serveFmu(int socket);

}  // namespace ballbot
