#pragma once

#include <string>

#include "hil/emulator/object_dictionary.hpp"

namespace ballbot {

/// The electronic data sheet (CiA 306) of a node: its object dictionary with defaults, as other
/// CANopen tools read it. Equal dictionaries give equal bytes.
/// @param file_name as its [FileInfo] names it
std::string edsText(const ObjectDictionary& dictionary, int node_id, const std::string& product,
                    const std::string& file_name, const std::string& vendor = "ballbot");

}  // namespace ballbot
