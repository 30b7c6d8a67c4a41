#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "controller/law_settings.hpp"
#include "core/registry.hpp"

namespace ballbot {

/// A mapping below `controller:` that laws are set by; several kinds may share one.
struct LawSection {
  ConfigKey key;
  std::function<void(ConfigVisitor&, const RobotParameters&)> describe;
};

/// A control law as a scenario chooses it: `controller.kind: NAME`.
struct LawKind {
  std::string name;
  /// Those it reads; a section is what its key says, whoever names it.
  std::vector<LawSection> sections;
  /// From the `controller:` section; reads its own sections of it and leaves the rest.
  /// @throw InputError, NumericalError for what cannot be read or cannot be balanced.
  std::function<std::unique_ptr<LawSettings>(ConfigReader&, const RobotParameters&)> read;
};

/// The LQR, the whole-body MPC and the decoupled baseline, and what others added (docs/adding.md).
Registry<LawKind>& lawKinds();

}  // namespace ballbot
