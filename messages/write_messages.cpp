// write_messages FOLDER: writes the files of messages/ that come from the tables of signals, where
// they have changed.
#include <cstdio>
#include <fstream>
#include <sstream>

#include "messages/message_text.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("write_messages: give the folder messages/ of the source tree\n", stderr);
    return 2;
  }
  for (const ballbot::WrittenFile& file : ballbot::messageFiles()) {
    const std::string path = std::string(argv[1]) + "/" + file.name;
    std::stringstream now;
    now << std::ifstream(path).rdbuf();
    if (now.str() == file.text) continue;
    std::ofstream out(path);
    out << file.text;
    if (!out.flush()) {
      std::fprintf(stderr, "write_messages: %s cannot be written\n", path.c_str());
      return 4;
    }
    std::printf("%s\n", path.c_str());
  }
  return 0;
}
