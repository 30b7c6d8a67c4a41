#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace ballbot {

/// Who may do what with an object (CiA 306): kReadWriteInput is rw that TPDOs carry ("rwr"),
/// kReadWriteOutput rw that RPDOs carry ("rww").
enum class EdsAccess {
  kConst,
  kReadOnly,
  kWriteOnly,
  kReadWrite,
  kReadWriteInput,
  kReadWriteOutput
};

/// A number of a data sheet, which may depend on the node: "$NODEID+0x180".
struct EdsNumber {
  std::int64_t value = 0;
  bool plus_node_id = false;
  std::int64_t at(int node) const { return value + (plus_node_id ? node : 0); }
};

/// One sub-index as a data sheet promises it.
struct EdsEntry {
  std::string name;
  int data_type = 0;  ///< index of CiA 301's data type: 5 is UNSIGNED8
  EdsAccess access = EdsAccess::kReadWrite;
  bool mappable = false;
  std::optional<EdsNumber> low, high;
  std::optional<EdsNumber> preset;      ///< DefaultValue
  std::optional<EdsNumber> configured;  ///< ParameterValue, of a DCF
  int line = 0;                         ///< of its section

  /// Bits of the type; 0 for texts and domains, whose length is not fixed.
  int bits() const;
  bool isSigned() const;
  bool readable() const { return access != EdsAccess::kWriteOnly; }
  bool writable() const { return access != EdsAccess::kConst && access != EdsAccess::kReadOnly; }
  bool inTransmitPdo() const;
  bool inReceivePdo() const;
};
/// "UNSIGNED16", or "type 0040" for one that CiA 301 does not fix.
std::string edsTypeName(int data_type);
/// "ro", as an EDS file says it.
const char* edsAccessName(EdsAccess access);

/// An electronic data sheet (EDS) or device configuration file (DCF) of CiA 306: what a vendor says
/// that a device is and has. Read whole, within bounds, without believing it: every number and name
/// is checked, objects that are listed must be described.
class DataSheet {
 public:
  /// @throw InputError "FILE:LINE: what came, what was expected".
  static DataSheet read(const std::string& path);
  static DataSheet parse(std::string_view text, const std::string& file);

  const std::string& file() const { return file_; }
  const std::string& vendor() const { return vendor_; }
  const std::string& product() const { return product_; }
  std::optional<std::int64_t> vendorNumber() const { return vendor_number_; }
  std::optional<std::int64_t> productNumber() const { return product_number_; }
  /// Bits that mapped objects must be whole multiples of; 0: PDOs cannot be mapped anew.
  int granularity() const { return granularity_; }
  /// Whether it says at all which bit rates the device has.
  bool hasRates() const { return !rates_.empty(); }
  bool hasRate(int kbps) const { return rates_.count(kbps) != 0; }
  /// Whether an RPDO may skip bytes by mapping this data type (1 to 7) as an object.
  bool hasDummy(int data_type) const { return dummies_.count(data_type) != 0; }
  /// Of the device that a DCF configures.
  std::optional<int> node() const { return node_; }

  bool hasIndex(std::uint16_t index) const { return indices_.count(index) != 0; }
  /// Null if the device has no such sub-index.
  const EdsEntry* find(std::uint16_t index, std::uint8_t sub) const;
  std::size_t entryCount() const { return entries_.size(); }

 private:
  friend class DataSheetReader;
  std::string file_, vendor_, product_;
  std::optional<std::int64_t> vendor_number_, product_number_;
  int granularity_ = 8;
  std::set<int> rates_, dummies_;
  std::optional<int> node_;
  std::set<std::uint16_t> indices_;
  std::map<std::pair<std::uint16_t, std::uint8_t>, EdsEntry> entries_;
};

}  // namespace ballbot
