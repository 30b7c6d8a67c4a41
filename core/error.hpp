#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace ballbot {

/// What a process returns to its shell.
enum class ExitCode : int {
  kPassed = 0,
  kRequirementMissed = 1,  ///< the scenario ran, the robot did not do what was asked of it
  kBadInput = 2,
  kLostParticipant = 3,  ///< a process of the run died, went silent or answered nonsense
  kOutputFailed = 4,     ///< the disk is full, a folder cannot be written
  kTorqueNotOff = 5,     ///< a drive of a bench has not said that its torque is off
  kInterrupted = 130,    ///< Ctrl-C, as shells have it
};

/// Base of everything this program throws. The text says where, what came, what was expected and
/// what to do; a kind of its own exists where a caller acts on it.
class Error : public std::runtime_error {
 public:
  Error(ExitCode exit_code, const std::string& text)
      : std::runtime_error(text), exit_code_(exit_code) {}
  ExitCode exitCode() const noexcept { return exit_code_; }

 private:
  ExitCode exit_code_;
};

/// A file, flag or argument cannot be used as it stands.
class InputError : public Error {
 public:
  explicit InputError(const std::string& text) : Error(ExitCode::kBadInput, text) {}
};

/// Another process of the run is missing, silent, or answered with an error.
class LostParticipantError : public Error {
 public:
  LostParticipantError(std::string participant, const std::string& text)
      : Error(ExitCode::kLostParticipant, text), participant_(std::move(participant)) {}
  const std::string& participant() const noexcept { return participant_; }

 private:
  std::string participant_;
};

/// A drive of a bench has not said that its torque is off: a person must take its power away.
class TorqueNotOffError : public Error {
 public:
  explicit TorqueNotOffError(const std::string& text) : Error(ExitCode::kTorqueNotOff, text) {}
};

/// Something could not be written.
class OutputError : public Error {
 public:
  explicit OutputError(const std::string& text) : Error(ExitCode::kOutputFailed, text) {}
};

/// The person asked to stop.
class InterruptedError : public Error {
 public:
  explicit InterruptedError(const std::string& text) : Error(ExitCode::kInterrupted, text) {}
};

/// A call came in a state that does not allow it, e.g. doStep before initialisation.
class CallOrderError : public Error {
 public:
  CallOrderError(std::string state, std::string call, const std::string& text)
      : Error(ExitCode::kBadInput, text), state_(std::move(state)), call_(std::move(call)) {}
  const std::string& state() const noexcept { return state_; }
  const std::string& call() const noexcept { return call_; }

 private:
  std::string state_, call_;
};

/// Numbers went wrong: NaN, a matrix that should be positive definite and is not, no equilibrium,
/// divergence. The same input gives the same numbers, so it is the input that cannot be used.
class NumericalError : public InputError {
 public:
  explicit NumericalError(const std::string& text) : InputError(text) {}
};

}  // namespace ballbot
