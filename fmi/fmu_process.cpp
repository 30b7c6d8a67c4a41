#include "fmi/fmu_process.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "fmi/fmu_wire.hpp"

namespace ballbot {
namespace {

/// The socket's end comes when the child is gone and its unpacked files are removed.
constexpr std::chrono::seconds kTidying{5};

BlobWriter request(FmuRequest kind) {
  BlobWriter out;
  putRequest(out, kind);
  return out;
}

void putPorts(BlobWriter& out, const std::vector<std::string>& names) {
  out.put<std::uint64_t>(names.size());
  for (const std::string& name : names) putText(out, name);
}

}  // namespace

FmuProcess::FmuProcess(FmuUse use, const std::string& program) : use_(std::move(use)) {
  start(program);
  try {
    open();
  } catch (...) {
    end();
    throw;
  }
}

void FmuProcess::start(const std::string& program) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    lost(fmt::format("no socket pair: {}", std::strerror(errno)));
  }
  std::string path = program, name = "ballbot", verb = kFmuServeVerb, flag = "--socket",
              number = std::to_string(ends[1]);
  char* arguments[] = {name.data(), verb.data(), flag.data(), number.data(), nullptr};
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    // Only async-signal-safe calls from here to exec.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // an FMU may not listen to anything less
    if (::getppid() != parent) ::_exit(3);
    ::setpgid(0, 0);  // Ctrl-C is the parent's business
    ::fcntl(ends[1], F_SETFD, 0);
    const int null = ::open("/dev/null", O_RDWR);
    ::dup2(null, 0);
    ::dup2(null, 1);  // what an FMU prints is no data of ours
    ::execv(path.c_str(), arguments);
    ::_exit(127);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  if (pid_ < 0) lost(fmt::format("cannot start: {}", std::strerror(errno)));
}

void FmuProcess::open() {
  BlobWriter open = request(FmuRequest::kOpen);
  putText(open, use_.name);
  putText(open, use_.file);
  putPorts(open, use_.inputs);
  std::vector<std::string> outputs = use_.outputs;
  if (!use_.digest.empty()) outputs.push_back(use_.digest);
  putPorts(open, outputs);
  open.put<std::uint64_t>(use_.parameters.size());
  for (const auto& [name, value] : use_.parameters) {
    putText(open, name);
    open.put(value);
  }
  ask(open, "open");
}

FmuProcess::~FmuProcess() { end(); }

void FmuProcess::end() {
  if (socket_ >= 0) ::shutdown(socket_, SHUT_WR);  // the child sees it and goes
  for (int waited_ms = 0; pid_ > 0 && ::waitpid(pid_, nullptr, WNOHANG) == 0; ++waited_ms) {
    if (waited_ms == 1000) ::kill(pid_, SIGKILL);
    ::usleep(1000);
  }
  if (socket_ < 0) return;
  awaitEndOfStream(socket_, kTidying);
  ::close(socket_);
}

void FmuProcess::enterInitializationMode(SimTime start) {
  BlobWriter out = request(FmuRequest::kInitialize);
  out.put(toNs(start));
  ask(out, "initialize");
}

void FmuProcess::evaluate(const std::vector<double>& inputs) {
  BlobWriter out = request(FmuRequest::kEvaluate);
  out.putVector(inputs);
  ask(out, "evaluate");
}

void FmuProcess::doStep(SimTime now, SimDuration step, const std::vector<double>& inputs) {
  if (only_step_ == SimDuration::zero()) only_step_ = step;
  if (!use_.variable_steps && step != only_step_) {
    throw InputError(
        fmt::format("FMU '{}' takes steps of one size only (canHandleVariableCommunicationStepSize "
                    "is false), but after {} this run has one of {}. Choose rates whose events are "
                    "evenly spaced",
                    use_.name, toText(only_step_), toText(step)));
  }
  BlobWriter out = request(FmuRequest::kStep);
  out.put(toNs(now));
  out.put(toNs(step));
  out.putVector(inputs);
  ask(out, "step");
}

void FmuProcess::terminate() { ask(request(FmuRequest::kTerminate), "terminate"); }
void FmuProcess::reset() {
  only_step_ = SimDuration::zero();
  ask(request(FmuRequest::kReset), "reset");
}

StateBlob FmuProcess::saveState() const {
  if (!use_.saves_state) {
    throw InputError(
        fmt::format("FMU '{}' cannot save its state (it does not say that it can get, "
                    "set and serialize it), so this run has no checkpoints",
                    use_.name));
  }
  return ask(request(FmuRequest::kSave), "save its state");
}

void FmuProcess::restoreState(const StateBlob& blob) {
  BlobWriter out = request(FmuRequest::kRestore);
  out.putBlob(blob);
  ask(out, "restore its state");
}

StateBlob FmuProcess::ask(const BlobWriter& request, const char* what) const {
  StateBlob answer;
  WireEnd end = sendBlob(socket_, request.seal(kFmuRequestKind, kFmuWireVersion));
  if (end == WireEnd::kOk) end = receiveBlob(socket_, answer, use_.patience);
  if (end == WireEnd::kTimeout) {
    ::kill(pid_, SIGKILL);
    awaitEndOfStream(socket_, kTidying);
    lost(fmt::format("no answer to '{}' within {} ms; its process was ended", what,
                     use_.patience.count()));
  }
  if (end == WireEnd::kClosed) lost(fmt::format("its process ended when asked to {}", what));
  BlobReader in(answer, kFmuReplyKind, kFmuWireVersion);
  const std::string text = getText(in);
  const auto status = in.get<FmuReply>();
  if (status == FmuReply::kInputError)
    throw InputError(fmt::format("FMU '{}': {}", use_.name, text));
  if (status == FmuReply::kNumericalError)
    throw LostParticipantError(use_.name, fmt::format("FMU '{}': {}", use_.name, text));
  if (status == FmuReply::kOutputError)
    throw OutputError(fmt::format("FMU '{}': {}", use_.name, text));
  outputs_ = in.getVector();
  if (!use_.digest.empty()) {
    // Two signed halves, low and high, at the end of the row.
    std::uint64_t half[2];
    for (int i = 1; i >= 0; --i) {
      half[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(outputs_.back()));
      outputs_.pop_back();
    }
    digest_ = half[1] << 32 | half[0];
  }
  StateBlob state = in.getBlob();
  in.finish();
  return state;
}

std::uint64_t FmuProcess::stateDigest() const {
  return use_.digest.empty() ? hash64(outputs_.data(), outputs_.size() * sizeof(double)) : digest_;
}

void FmuProcess::lost(const std::string& how) const {
  std::string death;
  int status = 0;
  // The end of the socket comes a moment before the end of the process.
  for (int waited_ms = 0; pid_ > 0 && waited_ms < 1000; ++waited_ms) {
    if (::waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      death = WIFEXITED(status) ? fmt::format(" (exit code {})", WEXITSTATUS(status))
                                : fmt::format(" (signal {}, {})", WTERMSIG(status),
                                              ::strsignal(WTERMSIG(status)));
    }
    ::usleep(1000);
  }
  throw LostParticipantError(use_.name,
                             fmt::format("FMU '{}' ({}): {}{}", use_.name, use_.file, how, death));
}

}  // namespace ballbot
