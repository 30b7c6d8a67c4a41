#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "hil/identify/configuration.hpp"
#include "hil/rehearsal/identify_trials.hpp"

namespace ballbot {

/// What `identify` found, for programs: figures with sigma, unit and what is configured, their
/// correlation, held-out records, both responses and their points.
nlohmann::ordered_json identificationJson(const Identification& found, const Configured& configured,
                                          const std::string& drive);

/// The same for people: a table of figures and one of held-out records.
std::string identificationTable(const Identification& found, const Configured& configured,
                                const std::string& drive);

/// Figures over many seeds of the noise, for programs and for people.
nlohmann::ordered_json trialsJson(const IdentifyTrials& trials);
std::string trialsTable(const IdentifyTrials& trials);

}  // namespace ballbot
