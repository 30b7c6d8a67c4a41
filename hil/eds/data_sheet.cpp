#include "hil/eds/data_sheet.hpp"

#include <cctype>
#include <fstream>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/printable_text.hpp"
#include "hil/eds/ini_text.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kMostIndex = 0xFFFF, kMostSub = 0xFE, kMostObjects = 0x10000;

std::optional<int> digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return std::nullopt;
}

/// Whole numbers as CiA 306 writes them: 0x for hexadecimal, a leading 0 for octal.
std::optional<std::int64_t> wholeNumber(std::string_view text) {
  const bool negative = !text.empty() && text[0] == '-';
  if (negative) text.remove_prefix(1);
  int base = 10;
  if (text.size() > 2 && text[0] == '0' && text[1] == 'x') {
    base = 16;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text[0] == '0') {
    base = 8;
  }
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) {
    const auto digit = digitOf(c);
    if (!digit || *digit >= base) return std::nullopt;
    if (value > (std::numeric_limits<std::int64_t>::max() - *digit) / base) return std::nullopt;
    value = value * base + *digit;
  }
  return negative ? -value : value;
}

}  // namespace

/// Makes a DataSheet of the sections of a file.
class DataSheetReader {
 public:
  DataSheetReader(const IniText& text, const std::string& file) : text_(text) {
    sheet_.file_ = file;
  }

  DataSheet read() {
    readDevice();
    readDummies();
    for (const char* list : {"mandatoryobjects", "optionalobjects", "manufacturerobjects"}) {
      readList(list);
    }
    for (const auto& [name, section] : text_.sections()) readSub(name, section);
    if (sheet_.indices_.empty()) {
      throw InputError(sheet_.file_ + ": lists no object; is it an EDS or DCF file of CiA 306?");
    }
    return std::move(sheet_);
  }

 private:
  using Section = IniText::Section;
  using Value = IniText::Value;

  [[noreturn]] void refuse(int line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", sheet_.file_, line, what));
  }

  EdsNumber number(const char* key, const Value& value) const {
    constexpr std::string_view kNode = "$nodeid";
    std::string rest = inSmallLetters(value.text);
    EdsNumber out;
    // In either order, with or without blanks: $NODEID+0x180, 0x180 + $NODEID.
    std::string bare;
    for (const char c : rest) {
      if (c != ' ' && c != '\t') bare += c;
    }
    const std::size_t at = bare.find(kNode);
    if (at != std::string::npos) {
      out.plus_node_id = true;
      bare.erase(at, kNode.size());
      if (!bare.empty() && bare[at == 0 ? 0 : at - 1] == '+') bare.erase(at == 0 ? 0 : at - 1, 1);
      if (bare.empty()) return out;
    }
    const auto whole = wholeNumber(bare);
    if (!whole || (out.plus_node_id && *whole > 0xFFFFFFFF)) {
      refuse(value.line, fmt::format("{} is '{}', must be a whole number such as 14, 0x1F or "
                                     "$NODEID+0x180",
                                     key, printableText(value.text)));
    }
    out.value = *whole;
    return out;
  }

  std::int64_t within(const char* key, const Value& value, std::int64_t low,
                      std::int64_t high) const {
    const EdsNumber n = number(key, value);
    if (n.plus_node_id || n.value < low || n.value > high) {
      refuse(value.line,
             fmt::format("{} is {}, must be {} to {}", key, printableText(value.text), low, high));
    }
    return n.value;
  }

  void readDevice() {
    if (const Section* device = text_.find("deviceinfo")) {
      if (const Value* v = device->find("vendorname")) sheet_.vendor_ = printableText(v->text);
      if (const Value* v = device->find("productname")) sheet_.product_ = printableText(v->text);
      const auto identity = [&](const char* key, std::optional<std::int64_t>& out) {
        const Value* v = device->find(inSmallLetters(key));
        if (v != nullptr && !v->text.empty()) out = within(key, *v, 0, 0xFFFFFFFF);
      };
      identity("VendorNumber", sheet_.vendor_number_);
      identity("ProductNumber", sheet_.product_number_);
      if (const Value* v = device->find("granularity")) {
        sheet_.granularity_ = static_cast<int>(within("Granularity", *v, 0, 64));
      }
      for (const int rate : {10, 20, 50, 125, 250, 500, 800, 1000}) {
        const std::string key = fmt::format("BaudRate_{}", rate);
        const Value* v = device->find(inSmallLetters(key));
        if (v != nullptr && within(key.c_str(), *v, 0, 1) == 1) sheet_.rates_.insert(rate);
      }
    }
    // So spelt in CiA 306.
    const Section* device = text_.find("devicecomissioning");
    if (device == nullptr) device = text_.find("devicecommissioning");
    if (device == nullptr) return;
    if (const Value* v = device->find("nodeid")) {
      sheet_.node_ = static_cast<int>(within("NodeID", *v, 1, 127));
    }
  }

  void readDummies() {
    const Section* section = text_.find("dummyusage");
    if (section == nullptr) return;
    for (int type = 1; type <= 7; ++type) {
      const std::string key = fmt::format("Dummy{:04X}", type);
      const Value* v = section->find(inSmallLetters(key));
      if (v != nullptr && within(key.c_str(), *v, 0, 1) == 1) sheet_.dummies_.insert(type);
    }
  }

  void readList(const std::string& name) {
    const Section* list = text_.find(name);
    if (list == nullptr) return;
    const Value* count = list->find("supportedobjects");
    if (count == nullptr) refuse(list->line, "[" + list->name + "] has no SupportedObjects");
    const std::int64_t objects = within("SupportedObjects", *count, 0, kMostObjects);
    for (std::int64_t n = 1; n <= objects; ++n) {
      const Value* v = list->find(fmt::format("{}", n));
      if (v == nullptr) {
        refuse(count->line,
               fmt::format("[{}] promises {} objects, has no number {}", list->name, objects, n));
      }
      const auto index = static_cast<std::uint16_t>(within("an object's index", *v, 1, kMostIndex));
      const Section* section = text_.find(inSmallLetters(fmt::format("{:04x}", index)));
      if (section == nullptr) {
        refuse(v->line, fmt::format("object {:04X} is listed, but there is no section [{:04X}]",
                                    index, index));
      }
      if (!sheet_.indices_.insert(index).second) {
        refuse(v->line, fmt::format("object {:04X} is listed twice", index));
      }
      readObject(index, *section);
    }
  }

  void readObject(std::uint16_t index, const Section& section) {
    constexpr std::int64_t kDomain = 2, kVariable = 7, kRecord = 9;
    const Value* shape = section.find("objecttype");
    const std::int64_t type =
        shape == nullptr ? kVariable : within("ObjectType", *shape, kDomain, kRecord);
    const Value* compact = section.find("compactsubobj");
    if (compact != nullptr) {
      const std::int64_t subs = within("CompactSubObj", *compact, 0, kMostSub);
      if (subs > 0) return readCompact(index, section, subs);
    }
    if (type == kVariable || type == kDomain) put(index, 0, section);
  }

  /// An array whose elements are all alike and described once.
  void readCompact(std::uint16_t index, const Section& section, std::int64_t subs) {
    EdsEntry count;
    count.name = "Highest sub-index supported";
    count.data_type = 5;
    count.access = EdsAccess::kReadOnly;
    count.preset = EdsNumber{subs, false};
    count.line = section.line;
    sheet_.entries_[{index, std::uint8_t{0}}] = count;
    for (std::int64_t sub = 1; sub <= subs; ++sub) {
      put(index, static_cast<std::uint8_t>(sub), section);
    }
  }

  // [1018sub4]; its index must be listed.
  void readSub(const std::string& name, const Section& section) {
    constexpr std::size_t kIndexDigits = 4;
    if (name.size() < kIndexDigits + 4 || name.compare(kIndexDigits, 3, "sub") != 0) return;
    const auto index = wholeNumber("0x" + name.substr(0, kIndexDigits));
    const auto sub = wholeNumber("0x" + name.substr(kIndexDigits + 3));
    if (!index || !sub) return;
    if (*index < 1 || *sub < 0 || *sub > 0xFF) {
      refuse(section.line, "[" + printableText(section.name) + "] is no sub-index of CANopen");
    }
    if (!sheet_.hasIndex(static_cast<std::uint16_t>(*index))) {
      refuse(section.line,
             fmt::format("[{}] describes a part of object {:04X}, which is not listed "
                         "among the objects",
                         printableText(section.name), *index));
    }
    put(static_cast<std::uint16_t>(*index), static_cast<std::uint8_t>(*sub), section);
  }

  void put(std::uint16_t index, std::uint8_t sub, const Section& section) {
    EdsEntry e;
    e.line = section.line;
    if (const Value* v = section.find("parametername")) e.name = printableText(v->text);
    const Value* type = section.find("datatype");
    if (type == nullptr) {
      refuse(section.line, "[" + printableText(section.name) + "] has no DataType");
    }
    e.data_type = static_cast<int>(within("DataType", *type, 1, kMostIndex));
    e.access = accessOf(section);
    if (const Value* v = section.find("pdomapping")) {
      e.mappable = within("PDOMapping", *v, 0, 1) == 1;
    }
    if (e.bits() > 0 && edsTypeName(e.data_type).rfind("REAL", 0) != 0) {
      e.low = limit("LowLimit", section, e);
      e.high = limit("HighLimit", section, e);
      e.preset = limit("DefaultValue", section, e);
      e.configured = limit("ParameterValue", section, e);
    }
    if (!sheet_.entries_.emplace(std::pair(index, sub), std::move(e)).second) {
      refuse(section.line, fmt::format("object {:04X}:{:02X} is described twice", index, sub));
    }
  }

  EdsAccess accessOf(const Section& section) const {
    const Value* v = section.find("accesstype");
    if (v == nullptr) {
      refuse(section.line, "[" + printableText(section.name) + "] has no AccessType");
    }
    const std::string text = inSmallLetters(v->text);
    for (const EdsAccess access :
         {EdsAccess::kConst, EdsAccess::kReadOnly, EdsAccess::kWriteOnly, EdsAccess::kReadWrite,
          EdsAccess::kReadWriteInput, EdsAccess::kReadWriteOutput}) {
      if (text == edsAccessName(access)) return access;
    }
    refuse(v->line, fmt::format("AccessType is '{}', must be ro, wo, rw, rwr, rww or const",
                                printableText(v->text)));
  }

  /// A number within its object's type; signed ones may be written as their bits: 0xFFFE is -2.
  std::optional<EdsNumber> limit(const char* key, const Section& section,
                                 const EdsEntry& entry) const {
    const Value* v = section.find(inSmallLetters(key));
    if (v == nullptr || v->text.empty()) return std::nullopt;
    EdsNumber n = number(key, *v);
    const int bits = entry.bits();
    if (bits >= 64) return n;
    const std::int64_t span = std::int64_t{1} << bits;
    const std::int64_t low = entry.isSigned() ? -span / 2 : 0;
    if (n.value < low || n.value >= span) {
      refuse(v->line, fmt::format("{} is {}, which {} cannot hold", key, printableText(v->text),
                                  edsTypeName(entry.data_type)));
    }
    if (entry.isSigned() && n.value >= span / 2) n.value -= span;
    return n;
  }

  const IniText& text_;
  DataSheet sheet_;
};

DataSheet DataSheet::parse(std::string_view text, const std::string& file) {
  const IniText sections(text, file);
  return DataSheetReader(sections, file).read();
}

DataSheet DataSheet::read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw InputError(path +
                     ": cannot be read. An EDS or DCF file comes with the drive, or from its "
                     "vendor's site");
  }
  // No more than one byte too many: what is longer is refused anyway.
  std::string text(IniText::kMostBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse(text, path);
}

const EdsEntry* DataSheet::find(std::uint16_t index, std::uint8_t sub) const {
  const auto it = entries_.find({index, sub});
  return it == entries_.end() ? nullptr : &it->second;
}

}  // namespace ballbot
