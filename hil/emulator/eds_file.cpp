#include "hil/emulator/eds_file.hpp"

#include <vector>

#include <fmt/format.h>

namespace ballbot {
namespace {

const char* accessText(OdAccess access) {
  switch (access) {
    case OdAccess::kConst:
      return "const";
    case OdAccess::kReadOnly:
      return "ro";
    case OdAccess::kWriteOnly:
      return "wo";
    case OdAccess::kReadWrite:
      return "rw";
  }
  return "";
}

std::string defaultText(const OdEntry& e, int node_id) {
  if (e.type == OdType::kText) return e.text;
  if (e.plus_node_id) return fmt::format("$NODEID+0x{:X}", e.initial - node_id);
  return isSigned(e.type) ? fmt::format("{}", e.initial) : fmt::format("0x{:X}", e.initial);
}

void putEntry(std::string& out, const OdEntry& e, int node_id) {
  out += fmt::format(
      "ObjectType=0x7\nDataType=0x{:04X}\nAccessType={}\nDefaultValue={}\nPDOMapping={}\n",
      static_cast<int>(e.type), accessText(e.access), defaultText(e, node_id), e.mappable ? 1 : 0);
  if (e.low) out += fmt::format("LowLimit={}\n", *e.low);
  if (e.high) out += fmt::format("HighLimit={}\n", *e.high);
}

void putList(std::string& out, const char* section, const std::vector<std::uint16_t>& indices) {
  out += fmt::format("\n[{}]\nSupportedObjects={}\n", section, indices.size());
  int n = 0;
  for (const std::uint16_t index : indices) out += fmt::format("{}=0x{:04X}\n", ++n, index);
}

}  // namespace

std::string edsText(const ObjectDictionary& d, int node_id, const std::string& product,
                    const std::string& file_name, const std::string& vendor) {
  std::vector<std::uint16_t> mandatory, optional, manufacturer;
  int receive = 0, transmit = 0;
  for (const auto& [index, object] : d.objects()) {
    const bool must = index == 0x1000 || index == 0x1001 || index == 0x1018;
    const bool own = index >= 0x2000 && index < 0x6000;
    (must ? mandatory : own ? manufacturer : optional).push_back(index);
    if (index >= 0x1400 && index < 0x1600) ++receive;
    if (index >= 0x1800 && index < 0x1A00) ++transmit;
  }
  std::string out = fmt::format(
      "[FileInfo]\nFileName={}\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\n"
      "Description={}\nCreationTime=12:00AM\nCreationDate=01-01-2026\nCreatedBy=ballbot\n"
      "ModificationTime=12:00AM\nModificationDate=01-01-2026\nModifiedBy=ballbot\n"
      "\n[DeviceInfo]\nVendorName={}\nVendorNumber=0x{:X}\nProductName={}\nProductNumber=0x{:"
      "X}\n"
      "RevisionNumber=0x{:X}\nOrderCode=0\n",
      file_name, product, vendor, d.value(0x1018, 1), product, d.value(0x1018, 2),
      d.value(0x1018, 3));
  for (const int rate : {10, 20, 50, 125, 250, 500, 800, 1000}) {
    out += fmt::format("BaudRate_{}={}\n", rate, rate == 1000 ? 1 : 0);
  }
  out += fmt::format(
      "SimpleBootUpMaster=0\nSimpleBootUpSlave=1\nGranularity=8\nDynamicChannelsSupported=0\n"
      "GroupMessaging=0\nNrOfRXPDO={}\nNrOfTXPDO={}\nLSS_Supported=0\n"
      "\n[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=1\nDummy0006="
      "1\n"
      "Dummy0007=1\n\n[Comments]\nLines=0\n",
      receive, transmit);
  putList(out, "MandatoryObjects", mandatory);
  putList(out, "OptionalObjects", optional);
  putList(out, "ManufacturerObjects", manufacturer);
  for (const auto& [index, object] : d.objects()) {
    out += fmt::format("\n[{:04X}]\nParameterName={}\n", index, object.name);
    if (object.shape == OdShape::kVariable) {
      putEntry(out, *d.find(index, 0), node_id);
      continue;
    }
    std::string subs;
    int count = 0;
    for (const auto& [key, entry] : d.entries()) {
      if (key.first != index) continue;
      ++count;
      subs += fmt::format("\n[{:04X}sub{:X}]\nParameterName={}\n", index, key.second, entry.name);
      putEntry(subs, entry, node_id);
    }
    out += fmt::format("ObjectType=0x{:X}\nSubNumber={}\n", static_cast<int>(object.shape), count);
    out += subs;
  }
  return out;
}

}  // namespace ballbot
