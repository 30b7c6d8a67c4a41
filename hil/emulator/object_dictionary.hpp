#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ballbot {

/// Types of CiA 301 that the emulated nodes use; the numbers are those of object 0005 and following
/// and of an EDS file.
enum class OdType : std::uint16_t {
  kI8 = 2,
  kI16 = 3,
  kI32 = 4,
  kU8 = 5,
  kU16 = 6,
  kU32 = 7,
  kText = 9
};
enum class OdAccess { kConst, kReadOnly, kReadWrite, kWriteOnly };
/// The kind of object an index holds, as EDS files number it.
enum class OdShape { kVariable = 7, kArray = 8, kRecord = 9 };

int sizeOf(OdType type);
bool isSigned(OdType type);

/// One sub-index of an emulated node's object dictionary.
struct OdEntry {
  std::string name;
  OdType type = OdType::kU32;
  OdAccess access = OdAccess::kReadWrite;
  std::int64_t value = 0;
  std::string text;           ///< of a kText object
  bool mappable = false;      ///< may be in a PDO
  bool plus_node_id = false;  ///< the default is what EDS files write as $NODEID + value
  std::optional<std::int64_t> low, high;
  std::int64_t initial = 0;  ///< value after a reset

  bool readable() const { return access != OdAccess::kWriteOnly; }
  bool writable() const { return access == OdAccess::kReadWrite || access == OdAccess::kWriteOnly; }
};

using OdKey = std::pair<std::uint16_t, std::uint8_t>;

/// What an index is called and which shape it has; its sub-indices are OdEntries.
struct OdObject {
  std::string name;
  OdShape shape = OdShape::kVariable;
};

/// All objects of one emulated node.
class ObjectDictionary {
 public:
  /// A variable at sub-index 0.
  OdEntry& variable(std::uint16_t index, const std::string& name, OdType type, OdAccess access,
                    std::int64_t value);
  OdEntry& text(std::uint16_t index, const std::string& name, const std::string& value);
  /// An array or record; add its entries with sub(). Sub-index 0, the highest one, is kept in step.
  void structure(std::uint16_t index, const std::string& name, OdShape shape);
  OdEntry& sub(std::uint16_t index, std::uint8_t sub, const std::string& name, OdType type,
               OdAccess access, std::int64_t value);

  OdEntry* find(std::uint16_t index, std::uint8_t sub);
  const OdEntry* find(std::uint16_t index, std::uint8_t sub) const;
  bool hasIndex(std::uint16_t index) const { return objects_.count(index) != 0; }
  /// The value of an object that is known to exist.
  std::int64_t value(std::uint16_t index, std::uint8_t sub = 0) const;
  void set(std::uint16_t index, std::int64_t value) { set(index, 0, value); }
  void set(std::uint16_t index, std::uint8_t sub, std::int64_t value);

  /// Values of `first` to `last` back to those after power-on.
  void reset(std::uint16_t first, std::uint16_t last);

  const std::map<std::uint16_t, OdObject>& objects() const { return objects_; }
  const std::map<OdKey, OdEntry>& entries() const { return entries_; }

 private:
  std::map<std::uint16_t, OdObject> objects_;
  std::map<OdKey, OdEntry> entries_;
};

}  // namespace ballbot
