#include "tools/number_options.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "core/number_text.hpp"

namespace ballbot {
namespace {

// To the command line library a leading zero means octal, 0x hexadecimal, and nothing a zero. So it
// gets to see only what is one number in plain decimal.
std::string asPlainDecimal(std::string& text, bool whole) {
  const std::optional<double> value = parseNumber(text);
  if (!value || !std::isfinite(*value))
    return "'" + text + "' is not a number; write it in decimal";
  if (!whole) {
    text = numberText(*value);
    return "";
  }
  const std::optional<std::int64_t> number = parseWhole(text);
  if (!number) return "'" + text + "' is not a whole number up to 2^53";
  text = std::to_string(*number);
  return "";
}

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

void readNumbers(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    const bool whole = begins(type, "INT") || begins(type, "UINT");
    if (!whole && !begins(type, "FLOAT")) continue;
    const bool negative = !begins(type, "UINT");
    option->transform(CLI::Validator(
        [whole, negative](std::string& text) {
          std::string trouble = asPlainDecimal(text, whole);
          if (trouble.empty() && !negative && text[0] == '-') trouble = text + " is negative";
          return trouble;
        },
        "", "decimal"));
  }
}

}  // namespace

void readNumbersAsFilesDo(CLI::App& program) {
  for (CLI::App* verb : program.get_subcommands({})) readNumbers(*verb);
}

}  // namespace ballbot
