#include "experiment/checkpoint_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".checkpoint";

void write(const Checkpoint& checkpoint, const std::string& path) {
  const StateBlob blob = checkpoint.toBlob();
  writeTextFile(path, std::string(blob.begin(), blob.end()));
}

Checkpoint read(const std::string& path) {
  const std::string bytes = readTextFile(path);
  try {
    return Checkpoint::fromBlob(StateBlob(bytes.begin(), bytes.end()));
  } catch (const InputError& e) {
    throw InputError(path + ": " + e.what());
  }
}

/// The time in a checkpoint's name, or nothing for other files.
std::optional<SimTime> timeOf(const fs::path& file) {
  if (file.extension() != kExtension) return std::nullopt;
  const auto ns = parseWhole(file.stem().string());
  if (!ns) return std::nullopt;
  return simTimeFromNs(*ns);
}

}  // namespace

void writeCheckpoint(const Checkpoint& checkpoint, const RunFolder& run) {
  std::error_code ignored;  // the write below says what is wrong
  fs::create_directory(run.checkpointsFolder(), ignored);
  write(checkpoint,
        fmt::format("{}/{:015}{}", run.checkpointsFolder(), toNs(checkpoint.time), kExtension));
}

std::optional<Checkpoint> lastCheckpoint(const RunFolder& run, SimTime time) {
  std::optional<SimTime> best;
  fs::path file;
  if (fs::is_directory(run.checkpointsFolder())) {
    for (const auto& entry : fs::directory_iterator(run.checkpointsFolder())) {
      const std::optional<SimTime> t = timeOf(entry.path());
      if (!t || *t > time || (best && *t <= *best)) continue;
      best = t;
      file = entry.path();
    }
  }
  if (best) return read(file.string());
  return readStart(run);
}

void writeStart(const Checkpoint& checkpoint, const RunFolder& run) {
  write(checkpoint, run.startFile());
}

std::optional<Checkpoint> readStart(const RunFolder& run) {
  if (!fs::exists(run.startFile())) return std::nullopt;
  return read(run.startFile());
}

}  // namespace ballbot
