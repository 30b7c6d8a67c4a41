#include "hil/data_sheet_check.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "hil/drive_setup.hpp"
#include "hil/shared_outputs.hpp"

namespace ballbot {
namespace {

using Kind = SetupStep::Kind;

bool isMapping(std::uint16_t index) {
  return (index >= 0x1600 && index < 0x1800) || (index >= 0x1A00 && index < 0x1C00);
}

/// Compares one device's set-up with its data sheet.
class SheetCheck {
 public:
  SheetCheck(const NamedDataSheet& named, int node) : sheet_(*named.sheet), node_(node) {}

  std::vector<std::string> run(const std::vector<SetupStep>& steps, int bitrate_kbps) {
    checkDevice(bitrate_kbps);
    for (const SetupStep& step : steps) checkStep(step);
    return std::move(found_);
  }

  /// PDOs that the device sends as it is delivered.
  void checkFixed(std::uint16_t mapping, const std::vector<std::uint32_t>& codes) {
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const ObjectAddress at{mapping, static_cast<std::uint8_t>(i + 1)};
      const EdsEntry* e = lookUp(at, "PDO mapping");
      if (e == nullptr || !e->preset || e->preset->value == codes[i]) continue;
      say(fmt::format("{} maps {:08X}, must map {:08X}: {}", toText(at), e->preset->value, codes[i],
                      place(*e)));
    }
  }

 private:
  void say(std::string text) {
    if (std::find(found_.begin(), found_.end(), text) == found_.end()) {
      found_.push_back(std::move(text));
    }
  }
  /// "drive.eds:812"
  std::string place(const EdsEntry& e) const { return fmt::format("{}:{}", sheet_.file(), e.line); }

  void checkDevice(int bitrate_kbps) {
    if (!sheet_.hasRate(bitrate_kbps) && sheet_.hasRates() && bitrate_kbps != 100) {
      say(
          fmt::format("its bus runs at {} kbit/s, which {} does not promise (BaudRate_{}). Set "
                      "bitrate_kbps of the bus",
                      bitrate_kbps, sheet_.file(), bitrate_kbps));
    }
    if (sheet_.node() && *sheet_.node() != node_) {
      say(fmt::format("{} configures node {}. Is it the file of another drive?", sheet_.file(),
                      *sheet_.node()));
    }
    if (sheet_.granularity() == 0) {
      say(fmt::format("its PDOs must be mapped, and {} says Granularity=0: they cannot be",
                      sheet_.file()));
    }
  }

  const EdsEntry* lookUp(ObjectAddress object, const char* what) {
    const EdsEntry* e = sheet_.find(object.index, object.sub);
    if (e == nullptr) {
      say(fmt::format("{} {}: {} has no {}", toText(object), what, sheet_.file(),
                      sheet_.hasIndex(object.index)
                          ? fmt::format("sub-index {:02X} of {:04X}", object.sub, object.index)
                          : fmt::format("object {:04X}", object.index)));
    }
    return e;
  }

  void checkStep(const SetupStep& step) {
    const EdsEntry* e = lookUp(step.object, step.what);
    if (e == nullptr) return;
    const std::string name = toText(step.object) + " " + step.what;
    if (step.kind == Kind::kWrite) {
      checkWrite(step, *e, name);
      if (!(step.check == step.object)) lookUp(step.check, step.what);
    } else {
      checkRead(step, *e, name);
    }
    if (isMapping(step.object.index) && step.object.sub > 0) {
      const auto code = static_cast<std::uint32_t>(step.value);
      checkMapped(code, step.object.index >= 0x1A00);
    }
  }

  void checkWrite(const SetupStep& step, const EdsEntry& e, const std::string& name) {
    if (!e.writable()) {
      say(fmt::format("{} is written, {} has it {}", name, place(e), edsAccessName(e.access)));
    }
    if (e.bits() != 8 * step.size) {
      say(fmt::format("{} is written with {} bits, {} has {}", name, 8 * step.size, place(e),
                      edsTypeName(e.data_type)));
      return;
    }
    const bool low = e.low && step.value < e.low->at(node_);
    const bool high = e.high && step.value > e.high->at(node_);
    if (low || high) {
      say(fmt::format("{} is to be {} ({:#x}), {} allows {} {}", name, step.value, step.value,
                      place(e), low ? "no less than" : "no more than",
                      low ? e.low->at(node_) : e.high->at(node_)));
    }
  }

  // What a sheet calls constant, or a DCF has configured, will be read.
  void checkRead(const SetupStep& step, const EdsEntry& e, const std::string& name) {
    if (!e.readable()) {
      say(fmt::format("{} is read, {} has it {}", name, place(e), edsAccessName(e.access)));
      return;
    }
    const bool fixed = e.access == EdsAccess::kConst ||
                       (step.kind == Kind::kExpectBits && e.access == EdsAccess::kReadOnly);
    const std::optional<EdsNumber>& known = e.configured ? e.configured : e.preset;
    if (!known || (!fixed && !e.configured)) return;
    const std::int64_t is = known->at(node_);
    bool good = is == step.value;
    if (step.kind == Kind::kExpectBits) good = (is & step.value) == step.value;
    if (step.kind == Kind::kAtLeast) good = is >= step.value;
    if (good) return;
    say(fmt::format("{} is {} ({:#x}) by {}, {} {} ({:#x})", name, is, is, place(e),
                    step.kind == Kind::kExpectBits ? "must have the bits"
                    : step.kind == Kind::kAtLeast  ? "must be at least"
                                                   : "configured",
                    step.value, step.value));
  }

  void checkMapped(std::uint32_t code, bool transmit) {
    const ObjectAddress object{static_cast<std::uint16_t>(code >> 16),
                               static_cast<std::uint8_t>(code >> 8 & 0xFF)};
    const int bits = static_cast<int>(code & 0xFF);
    const char* direction = transmit ? "TPDO" : "RPDO";
    if (isDummy(object)) {
      if (!transmit && sheet_.hasDummy(object.index)) return;
      say(fmt::format(
          "{} fills up an RPDO that drives share (shared_outputs), {} says Dummy{:04X}=0",
          toText(object), sheet_.file(), object.index));
      return;
    }
    const EdsEntry* e = lookUp(object, transmit ? "in a TPDO" : "in an RPDO");
    if (e == nullptr) return;
    if (transmit ? !e->inTransmitPdo() : !e->inReceivePdo()) {
      say(fmt::format("{} {} cannot be mapped into {} {}: {} has PDOMapping={}, AccessType={}",
                      toText(object), e->name, transmit ? "a" : "an", direction, place(*e),
                      e->mappable ? 1 : 0, edsAccessName(e->access)));
    }
    if (e->bits() != bits) {
      say(fmt::format("{} {} is mapped with {} bits, {} has {}. Map {:04X}{:02X}{:02X}",
                      toText(object), e->name, bits, place(*e), edsTypeName(e->data_type),
                      object.index, object.sub, e->bits()));
    }
    if (sheet_.granularity() > 0 && bits % sheet_.granularity() != 0) {
      say(fmt::format("{} is mapped with {} bits, {} maps multiples of {} (Granularity)",
                      toText(object), bits, sheet_.file(), sheet_.granularity()));
    }
  }

  const DataSheet& sheet_;
  int node_;
  std::vector<std::string> found_;
};

/// Equal disagreements of several drives are said once.
class Collector {
 public:
  void add(const std::string& where, const std::string& name, std::vector<std::string> texts) {
    for (std::string& text : texts) {
      const auto same = std::find_if(all_.begin(), all_.end(), [&](const Item& item) {
        return item.where == where && item.text == text;
      });
      if (same == all_.end()) {
        all_.push_back({where, name, std::move(text)});
      } else {
        same->names += ", " + name;
      }
    }
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> out;
    for (const Item& item : all_) {
      out.push_back(fmt::format("{}: {}: {}", item.where, item.names, item.text));
    }
    return out;
  }

 private:
  struct Item {
    std::string where, names, text;
  };
  std::vector<Item> all_;
};

int rateOf(const BenchConfig& config, int bus) {
  return config.buses[static_cast<std::size_t>(bus)].settings.bitrate_kbps;
}

}  // namespace

std::vector<std::string> checkDataSheets(const BenchConfig& config) {
  Collector all;
  for (const DriveConfig& drive : config.drives) {
    if (!drive.data_sheet) continue;
    SheetCheck check(drive.data_sheet, drive.node);
    all.add(drive.data_sheet.where, drive.name,
            check.run(driveSetup(config, drive), rateOf(config, drive.bus)));
  }
  if (config.imu.data_sheet) {
    SheetCheck check(config.imu.data_sheet, config.imu.node);
    if (!config.flexible()) {
      check.checkFixed(0x1A00, {0x20010110, 0x20010210, 0x20010310, 0x20030010});
      check.checkFixed(0x1A01, {0x20020110, 0x20020210, 0x20020310});
    }
    all.add(config.imu.data_sheet.where, "IMU",
            check.run(imuSetup(config), rateOf(config, config.imu.bus)));
  }
  return all.texts();
}

void requireDataSheets(const BenchConfig& config) {
  const std::vector<std::string> texts = checkDataSheets(config);
  if (texts.empty()) return;
  std::string all = fmt::format(
      "{} of the bench file's wishes do not fit the drives' data sheets; "
      "no bus was touched:",
      texts.size());
  for (const std::string& text : texts) all += "\n  " + text;
  all += "\ndocs/troubleshooting/bench-data-sheet.md";
  throw InputError(all);
}

}  // namespace ballbot
