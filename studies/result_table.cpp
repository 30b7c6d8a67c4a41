#include "studies/result_table.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/key_unit.hpp"
#include "experiment/verdict.hpp"

namespace ballbot {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

struct Row {
  const StudyCase* c;
  const CaseResult* r;
};

}  // namespace

std::string ResultTable::csv() const {
  fmt::memory_buffer out;
  const auto put = [&](const std::string& text) {
    out.append(text.data(), text.data() + text.size());
  };
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c > 0) out.push_back(',');
    put(quoted(columns[c].unit.empty() ? columns[c].name
                                       : fmt::format("{} [{}]", columns[c].name, columns[c].unit)));
  }
  out.push_back('\n');
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c > 0) out.push_back(',');
      if (columns[c].isText()) {
        put(quoted(columns[c].words[row]));
      } else if (std::isfinite(columns[c].numbers[row])) {
        fmt::format_to(std::back_inserter(out), "{}", columns[c].numbers[row]);
      }
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

std::string ResultTable::digest() const {
  Digest digest;
  digest.add(csv());
  return digest.hex();
}

ResultTable makeResultTable(const Study& study, const std::vector<StudyCase>& cases,
                            const std::map<std::string, CaseResult>& results) {
  std::vector<Row> rows;
  std::set<std::string> metrics;
  for (const StudyCase& c : cases) {
    const auto it = results.find(c.id);
    if (it == results.end()) continue;
    rows.push_back({&c, &it->second});
    for (const auto& metric : it->second.metrics) metrics.insert(metric.first);
  }
  ResultTable table;
  table.rows = rows.size();
  const auto words = [&](const std::string& name, auto get) {
    ResultTable::Column column{name, "", {}, {}};
    for (const Row& row : rows) column.words.push_back(get(row));
    table.columns.push_back(std::move(column));
  };
  const auto numbers = [&](const std::string& name, const std::string& unit, auto get) {
    ResultTable::Column column{name, unit, {}, {}};
    for (const Row& row : rows) column.numbers.push_back(get(row));
    table.columns.push_back(std::move(column));
  };
  words("case", [](const Row& row) { return row.c->id; });
  numbers("seed", "", [](const Row& row) { return static_cast<double>(row.c->seed); });
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const StudyAxis& axis = study.axes[a];
    bool numeric = true;
    for (const Row& row : rows) numeric = numeric && std::isfinite(row.c->point[a].number);
    if (numeric) {
      numbers(axis.name, axis.unit, [a](const Row& row) { return row.c->point[a].number; });
    } else {
      words(axis.name, [a](const Row& row) { return row.c->point[a].label; });
    }
  }
  words("outcome", [](const Row& row) { return toText(row.r->outcome); });
  words("reason", [](const Row& row) { return row.r->reason; });
  numbers("simulated_s", "s", [](const Row& row) { return row.r->simulated_s; });
  for (const std::string& name : metrics) {
    numbers(name, unitOfKey(name), [&](const Row& row) {
      const auto it = row.r->metrics.find(name);
      return it == row.r->metrics.end() ? kNone : it->second;
    });
  }
  words("trajectory_digest", [](const Row& row) { return row.r->trajectory_digest; });
  return table;
}

}  // namespace ballbot
