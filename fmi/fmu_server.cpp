// The process an FMU lives in: one request, one reply.
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/fmu_ports.hpp"
#include "fmi/fmu_process.hpp"
#include "fmi/fmu_slave.hpp"
#include "fmi/fmu_wire.hpp"
#include "fmi/scratch_folder.hpp"
#include "fmi/zip_archive.hpp"

namespace ballbot {
namespace {

class FmuServer {
 public:
  /// The other end of `socket` sees its end when this process is gone and its folder, too.
  explicit FmuServer(int socket) : socket_(socket) {}

  /// Acts on one request. @throw Error
  StateBlob act(BlobReader& in) {
    const auto kind = in.get<FmuRequest>();
    if (kind != FmuRequest::kOpen && !slave_) throw InputError("not open");
    switch (kind) {
      case FmuRequest::kOpen:
        open(in);
        break;
      case FmuRequest::kInitialize:
        for (const auto& [port, value] : parameters_) slave_->set(port, &value);
        slave_->initialize(simTimeFromNs(in.get<std::int64_t>()));
        takeOutputs();
        break;
      case FmuRequest::kEvaluate:
        setInputs(in.getVector());
        takeOutputs();
        break;
      case FmuRequest::kStep:
        step(in);
        break;
      case FmuRequest::kTerminate:
        slave_->terminate();
        break;
      case FmuRequest::kReset:
        slave_->reset();
        break;
      case FmuRequest::kSave:
        return slave_->saveState();
      case FmuRequest::kRestore:
        slave_->restoreState(in.getBlob());
        takeOutputs();
        break;
    }
    return {};
  }
  const std::vector<double>& outputs() const { return outputs_; }

 private:
  void open(BlobReader& in) {
    const std::string name = getText(in), file = getText(in);
    const FmuDescription fmu = readFmuDescription(file);
    folder_.emplace(socket_);
    unpackZip(file, folder_->path());
    inputs_ = ports(in, fmu);
    output_ports_ = ports(in, fmu);
    for (auto count = in.get<std::uint64_t>(); count > 0; --count) {
      const FmuPort port = findPort(fmu, getText(in));
      parameters_.emplace_back(port, in.get<double>());
      if (port.size != 1) throw InputError(fmt::format("parameter '{}' is an array", port.name));
    }
    std::size_t size = 0;
    for (const FmuPort& port : output_ports_) size += static_cast<std::size_t>(port.size);
    outputs_.assign(size, 0.0);
    slave_ = loadFmu(fmu, folder_->path(), name, {});
  }
  static std::vector<FmuPort> ports(BlobReader& in, const FmuDescription& fmu) {
    std::vector<FmuPort> out;
    for (auto count = in.get<std::uint64_t>(); count > 0; --count)
      out.push_back(findPort(fmu, getText(in)));
    return out;
  }
  void step(BlobReader& in) {
    const SimTime now = simTimeFromNs(in.get<std::int64_t>());
    const SimDuration length{in.get<std::int64_t>()};
    setInputs(in.getVector());
    slave_->doStep(now, length);
    takeOutputs();
  }
  void setInputs(const std::vector<double>& values) {
    std::size_t at = 0;
    for (const FmuPort& port : inputs_) {
      if (at + static_cast<std::size_t>(port.size) > values.size()) {
        throw InputError("too few input values");
      }
      slave_->set(port, &values[at]);
      at += static_cast<std::size_t>(port.size);
    }
  }
  void takeOutputs() {
    std::size_t at = 0;
    for (const FmuPort& port : output_ports_) {
      slave_->get(port, &outputs_[at]);
      at += static_cast<std::size_t>(port.size);
    }
  }

  int socket_;
  std::optional<ScratchFolder> folder_;  // goes last
  std::unique_ptr<FmuSlave> slave_;
  std::vector<FmuPort> inputs_, output_ports_;
  std::vector<std::pair<FmuPort, double>> parameters_;
  std::vector<double> outputs_;
};

}  // namespace

int serveFmu(int socket) {
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);  // programs that an FMU starts must not hold it open
  FmuServer server(socket);
  StateBlob message;
  while (receiveBlob(socket, message, std::chrono::milliseconds{0}) == WireEnd::kOk) {
    FmuReply status = FmuReply::kOk;
    std::string text;
    StateBlob state;
    try {
      BlobReader in(message, kFmuRequestKind, kFmuWireVersion);
      state = server.act(in);
    } catch (const NumericalError& e) {
      status = FmuReply::kNumericalError;
      text = e.what();
    } catch (const OutputError& e) {
      status = FmuReply::kOutputError;
      text = e.what();
    } catch (const std::exception& e) {
      status = FmuReply::kInputError;
      text = e.what();
    }
    BlobWriter reply;
    putText(reply, text);
    reply.put(status);
    reply.putVector(server.outputs());
    reply.putBlob(state);
    if (sendBlob(socket, reply.seal(kFmuReplyKind, kFmuWireVersion)) != WireEnd::kOk) break;
  }
  return 0;
}

}  // namespace ballbot
