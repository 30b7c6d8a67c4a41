#pragma once

#include "controller/law_registry.hpp"

namespace ballbot {

// The laws of this program, for the registry.
LawKind lqrKind();
LawKind mpcKind();
LawKind decoupledKind();

// Sections that more than one of them reads.
LawSection lqrSection();
LawSection mpcSection();

}  // namespace ballbot
