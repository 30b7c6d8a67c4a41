#include "report/write_report.hpp"

#include <cstring>

#include "core/error.hpp"
#include "core/markup_text.hpp"
#include "core/whole_file.hpp"
#include "report/json_text.hpp"
#include "report/page_template.hpp"
#include "report/report_check.hpp"
#include "report/report_json.hpp"

namespace ballbot {

namespace {

/// JSON that may stand inside a script element: "</script>" or "<!--" in a text would end it.
std::string scriptSafe(const nlohmann::ordered_json& json) {
  constexpr int kNoIndent = -1;
  const std::string text = jsonText(json, kNoIndent);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string reportPage(const ReportData& data, const std::string& urdf_text,
                       const ReportSize& size) {
  checkReportData(data, urdf_text);
  const std::string& page = pageTemplate();
  const std::size_t title_at = page.find(kTitleMark);
  const std::size_t after_title = title_at + std::strlen(kTitleMark);
  const std::size_t data_at = page.find(kDataMark, after_title);
  const std::size_t after_data = data_at + std::strlen(kDataMark);
  const std::string title = (data.passed ? "Passed: " : "Failed: ") + data.title;
  return page.substr(0, title_at) + markupEscaped(title) +
         page.substr(after_title, data_at - after_title) +
         scriptSafe(reportJson(data, urdf_text, size)) + page.substr(after_data);
}

void writeReport(const ReportData& data, const std::string& urdf_text, const std::string& path,
                 const ReportSize& size) {
  if (const int reason = writeWholeFile(path, reportPage(data, urdf_text, size))) {
    throw OutputError(path + ": the report cannot be written: " + std::strerror(reason));
  }
}

}  // namespace ballbot
