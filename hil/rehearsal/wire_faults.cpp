#include "hil/rehearsal/wire_faults.hpp"

#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace ballbot {
namespace {

constexpr int kDrivesOnBus0 = 3, kImuNode = 7, kPdos = 3;

std::int64_t read(const CanFrame& f, int begin, int bytes) {
  std::uint64_t value = 0;
  for (int i = bytes - 1; i >= 0; --i) {
    value = value << 8 | f.data[static_cast<std::size_t>(begin + i)];
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * bytes - 1);
  return static_cast<std::int64_t>((value ^ sign) - sign);
}

void write(CanFrame& f, int begin, int bytes, std::int64_t value) {
  for (int i = 0; i < bytes; ++i) {
    f.data[static_cast<std::size_t>(begin + i)] =
        static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
  }
}

TamperedBus::Rewrite changing(std::uint32_t id, FrameChange change) {
  return [id, change = std::move(change)](const CanFrame& f, std::vector<CanFrame>& out) {
    out.push_back(f);
    if (f.id == id && !f.extended) change(out.back());
  };
}

/// Number of the PDO (from 1) if it is this drive's, else 0.
int pdoOf(const CanFrame& f, int drive) {
  for (int n = 1; n <= kPdos; ++n) {
    if (f.id == tpdoOf(drive, n)) return n;
  }
  return 0;
}

}  // namespace

int busOfDrive(int drive) { return drive < kDrivesOnBus0 ? 0 : 1; }
std::uint32_t tpdoOf(int drive, int number) {
  return 0x80U + 0x100U * static_cast<unsigned>(number) + static_cast<unsigned>(drive + 1);
}
std::uint32_t rpdoOf(int drive, int number) {
  return 0x100U + 0x100U * static_cast<unsigned>(number) + static_cast<unsigned>(drive + 1);
}
std::uint32_t imuPdo(int number) { return tpdoOf(kImuNode - 1, number); }

void changeToMaster(Rehearsal& r, int bus, std::uint32_t id, FrameChange change) {
  r.wire(bus).onWayToMaster(changing(id, std::move(change)));
}
void changeToDrives(Rehearsal& r, int bus, std::uint32_t id, FrameChange change) {
  r.wire(bus).onWayToDrives(changing(id, std::move(change)));
}

FrameChange freezeBytes(int begin, int end) {
  return [=, kept = std::optional<CanFrame>()](CanFrame& f) mutable {
    if (!kept) kept = f;
    for (int i = begin; i < end && i < f.size; ++i) {
      f.data[static_cast<std::size_t>(i)] = kept->data[static_cast<std::size_t>(i)];
    }
  };
}
FrameChange addTo(int begin, int bytes, std::int64_t value) {
  return [=](CanFrame& f) { write(f, begin, bytes, read(f, begin, bytes) + value); };
}
FrameChange negate(int begin, int bytes) {
  return [=](CanFrame& f) { write(f, begin, bytes, -read(f, begin, bytes)); };
}
FrameChange put(int begin, int bytes, std::int64_t value) {
  return [=](CanFrame& f) { write(f, begin, bytes, value); };
}

void losePdos(Rehearsal& r, int drive, std::function<bool(int)> lost) {
  r.wire(busOfDrive(drive))
      .onWayToMaster([drive, lost = std::move(lost), cycle = -1](
                         const CanFrame& f, std::vector<CanFrame>& out) mutable {
        const int pdo = pdoOf(f, drive);
        if (pdo == 1) ++cycle;
        if (pdo == 0 || !lost(cycle < 0 ? 0 : cycle)) out.push_back(f);
      });
}

void delayPdos(Rehearsal& r, int drive) {
  r.wire(busOfDrive(drive))
      .onWayToMaster([drive, held = std::map<int, CanFrame>()](const CanFrame& f,
                                                               std::vector<CanFrame>& out) mutable {
        const int pdo = pdoOf(f, drive);
        if (pdo == 0) return out.push_back(f);
        const auto it = held.find(pdo);
        if (it != held.end()) out.push_back(it->second);
        held[pdo] = f;
      });
}

void swapToMaster(Rehearsal& r, int bus, std::uint32_t a, std::uint32_t b) {
  r.wire(bus).onWayToMaster([=](const CanFrame& f, std::vector<CanFrame>& out) {
    out.push_back(f);
    if (f.id == a || f.id == b) out.back().id = f.id == a ? b : a;
  });
}

CanFrame sdoWrite(int drive, std::uint16_t index, int sub, std::int64_t value, int bytes) {
  CanFrame f;
  f.id = 0x601U + static_cast<unsigned>(drive);
  f.size = 8;
  f.data[0] = static_cast<std::uint8_t>(0x23 | (4 - bytes) << 2);
  write(f, 1, 2, index);
  f.data[3] = static_cast<std::uint8_t>(sub);
  write(f, 4, bytes, value);
  return f;
}

CanFrame foreignCommand(int drive, std::uint16_t controlword, int torque) {
  CanFrame f;
  f.id = rpdoOf(drive, 1);
  f.size = 4;
  write(f, 0, 2, controlword);
  write(f, 2, 2, torque);
  return f;
}

void tellDrive(Rehearsal& r, int drive, const CanFrame& frame) {
  r.drives().drive(drive).onFrame(frame);
}

}  // namespace ballbot
