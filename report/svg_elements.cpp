#include "report/svg_elements.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/markup_text.hpp"

namespace ballbot {

std::string svgNumber(double v) { return fmt::format("{:.2f}", v); }

std::string tickText(double v) {
  const double size = std::abs(v);
  if (v != 0 && (size >= 1e5 || size < 1e-3)) return fmt::format("{:.0e}", v);
  return fmt::format("{:g}", v);
}

std::string lineElement(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line x1='{}' y1='{}' x2='{}' y2='{}' {}/>\n", svgNumber(x1), svgNumber(y1),
                     svgNumber(x2), svgNumber(y2), style);
}

std::string textElement(double x, double y, const std::string& anchor, const std::string& text,
                        const std::string& more) {
  return fmt::format("<text x='{}' y='{}' text-anchor='{}' {}>{}</text>\n", svgNumber(x),
                     svgNumber(y), anchor, more, markupEscaped(text));
}

std::string figureBeginning(const std::string& title, double width, double height,
                            double title_left) {
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "role='img'>\n"
      "<title>{2}</title>\n"
      "<style>text{{font:12px system-ui,sans-serif;fill:#222}}.label{{font-size:13px}}"
      ".title{{font-size:16px;font-weight:600}}.grid{{stroke:#ccc}}.minor{{stroke:#eee}}"
      ".span{{fill:#fbeed2}}.mark{{stroke:#555;stroke-dasharray:2 3}}</style>\n"
      "<rect width='{0}' height='{1}' fill='#fff'/>\n",
      svgNumber(width), svgNumber(height), markupEscaped(title));
  if (!title.empty()) out += textElement(title_left, 25, "start", title, "class='title'");
  return out;
}

}  // namespace ballbot
