#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// A file of messages/ that is written from the tables of model/signal_table.hpp.
struct WrittenFile {
  std::string name;  ///< in messages/
  std::string text;
};

/// Definitions of the messages that carry frames, and frame_fields.hpp. `write_messages` writes
/// them; a test holds the files against them.
std::vector<WrittenFile> messageFiles();

}  // namespace ballbot
