#include "controller/law_registry.hpp"

#include "controller/law_kinds.hpp"

namespace ballbot {

Registry<LawKind>& lawKinds() {
  static Registry<LawKind> kinds({lqrKind(), mpcKind(), decoupledKind()});
  return kinds;
}

}  // namespace ballbot
