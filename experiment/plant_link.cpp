#include "experiment/plant_link.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "cosim/lifecycle.hpp"
#include "experiment/plant_factory.hpp"
#include "plant/added_truth.hpp"

namespace ballbot {
namespace {

/// In the environment of a child: without it a program whose main() knows no 'plant' would start
/// itself again and again.
constexpr const char* kStartedAsPlant = "BALLBOT_STARTED_AS_PLANT";

}  // namespace

std::uint64_t configDigest64(const Scenario& scenario) {
  const std::string digest = scenario.configDigest();
  return hash64(digest.data(), digest.size());
}

PlantLink::PlantLink(const RunConfig& config, const RunFolder& folder, Options options)
    : config_(config),
      folder_(folder),
      options_(std::move(options)),
      stderr_path_(folder.path() + "/plant.stderr") {
  start();
}

PlantLink::~PlantLink() {
  remote_.reset();  // tells the far end to stop, if the run did not come to its end
  child_.reset();
  // Nothing on stderr is nothing to keep.
  std::error_code ignored;
  if (std::filesystem::file_size(stderr_path_, ignored) == 0) {
    std::filesystem::remove(stderr_path_, ignored);
  }
}

void PlantLink::start() {
  if (!options_.in_process && std::getenv(kStartedAsPlant) != nullptr) {
    throw InputError(
        "this program was started as the plant of a run, with the word 'plant', and began a run "
        "itself: let its main() answer that word with servePlant(), or run with "
        "RunOptions::in_process");
  }
  if (options_.in_process) {
    local_ = std::make_unique<Lifecycle>(makePlant(config_.plant));
    return;
  }
  LcmAddress address = options_.address;
  if (address.url.empty()) {
    address = options_.shared ? LcmAddress{sharedLcmAddress().url, options_.address.channel}
                              : privateLcmAddress();
    ::setenv(kStartedAsPlant, "1", 1);
    child_ = std::make_unique<ChildProcess>(
        "plant",
        std::vector<std::string>{"plant", folder_.scenarioFile(), "--lcm-url", address.url,
                                 "--channel", address.channel, "--quiet"},
        stderr_path_, options_.core);
    ::unsetenv(kStartedAsPlant);
  }
  transport_ = std::make_unique<LcmTransport>(address, LinkEnd::kMaster);
  RemoteOptions remote;
  remote.config_digest = configDigest64(config_.scenario);
  remote.patience = options_.patience;
  // A plant that is served elsewhere runs already; one that we start needs time to set itself up.
  remote.first_patience =
      child_ ? std::max(options_.patience, std::chrono::milliseconds(30'000)) : options_.patience;
  remote.added[AddedTo::kSensors] = config_.plant.plant.added_sensors.signals();
  const AddedSignals truth = AddedTruth(config_.plant.plant).signals();
  if (!config_.plant.coupling || config_.plant.coupling->feeds(truth)) {
    remote.added[AddedTo::kTruth] = truth;
  }
  remote.stop = options_.stop;
  remote.say = options_.say;
  if (child_) {
    remote.peer_trouble = [this] { return troubleOfChild(); };
  }
  remote_ = std::make_unique<RemoteParticipant>(*transport_, remote);
}

// What the plant says of its input it says of ours.
std::string PlantLink::troubleOfChild() {
  if (child_->running()) return "";
  if (child_->exitCode() == static_cast<int>(ExitCode::kBadInput)) {
    throw InputError(child_->lastLine());
  }
  return child_->lastWords();
}

Participant& PlantLink::participant() {
  return local_ ? *local_ : static_cast<Participant&>(*remote_);
}

void PlantLink::replace() {
  if (child_) child_->kill();
  remote_.reset();
  transport_.reset();
  child_.reset();
  start();
}

void PlantLink::close() {
  if (!child_) return;
  child_->finish(3000);
}

RemoteParticipant::LinkStatistics PlantLink::statistics() const {
  return remote_ ? remote_->statistics() : RemoteParticipant::LinkStatistics{};
}

}  // namespace ballbot
