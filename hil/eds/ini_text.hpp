#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace ballbot {

/// Text as EDS and DCF files have it: sections in brackets, key=value, ';' before a comment. Names
/// of sections and keys are found in any case. Read strictly and within bounds, for it comes from
/// strangers.
class IniText {
 public:
  static constexpr std::size_t kMostBytes = 4U << 20, kLongestLine = 4096, kMostSections = 65'536;

  struct Value {
    std::string text;
    int line = 0;
  };
  struct Section {
    std::string name;  ///< as it is written
    int line = 0;
    std::map<std::string, Value> values;  ///< by key in small letters
    /// The value of `key` (in small letters), or null.
    const Value* find(const std::string& key) const;
  };

  /// @param file  name for messages
  /// @throw InputError "FILE:LINE: ..." for what is no section, no assignment, given twice or too
  ///        long.
  IniText(std::string_view text, const std::string& file);

  /// By name in small letters; null if there is none.
  const Section* find(const std::string& name) const;
  const std::map<std::string, Section>& sections() const { return sections_; }

 private:
  std::map<std::string, Section> sections_;
};

/// Small letters for A to Z; other bytes stay.
std::string inSmallLetters(std::string_view text);

}  // namespace ballbot
