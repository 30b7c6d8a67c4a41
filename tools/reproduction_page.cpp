#include "tools/reproduction_page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/key_unit.hpp"

namespace ballbot {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>The paper's experiments, repeated</title>
<style>
body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1000px;margin:0 auto;padding:24px}
h1{font-size:24px}h2{font-size:19px;margin:40px 0 8px;border-top:1px solid #ccc;padding-top:18px}
table{border-collapse:collapse;margin:10px 0;width:100%}
th,td{text-align:left;padding:4px 10px 4px 0;border-bottom:1px solid #e3e3e3;vertical-align:top}
td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.ok{color:#00724f;font-weight:600}.no{color:#b3261e;font-weight:600}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:8px 28px}
.pair h3{font-size:14px;margin:0;color:#555}.pair p{margin:0}
svg{max-width:100%;height:auto}.scroll{overflow-x:auto}
@media(max-width:640px){.wide{display:none}.pair{grid-template-columns:1fr}body{padding:14px}}
@media print{h2{break-before:auto}svg,table{break-inside:avoid}}
</style></head><body>
<h1>The paper's experiments, repeated</h1>
<p>Minniti, Farshidian, Grandia, Hutter, <i>Whole-Body MPC for a Dynamically Stable Mobile Manipulator</i>, RA-L
2019, in simulation: series elastic drives, friction, noisy sensors and an estimator, plans that act late. The
limits are the scenarios' own requirements.</p>
)";

std::string verdict(bool passed) {
  return passed ? "<span class='ok'>passed</span>" : "<span class='no'>MISSED</span>";
}

std::string number(const std::string& metric, double value) {
  const std::string unit = unitOfKey(metric);
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string escaped(std::string text) {
  for (const auto& [from, to] :
       {std::pair<const char*, const char*>{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}}) {
    const std::string what(from), by(to);
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
      text.replace(at, what.size(), by);
    }
  }
  return text;
}

/// Every requirement with its value, then the other numbers that matter.
std::string numbersTable(const ReproducedExperiment& e) {
  std::string out =
      "<div class='scroll'><table><tr><th>number</th><th>value</th><th>limit</th><th></th></tr>\n";
  for (const VerdictRow& row : e.result->verdicts) {
    out += fmt::format("<tr><td>{}</td><td class='n'>{}</td><td>{}</td><td>{}</td></tr>\n",
                       row.metric, row.measured ? number(row.metric, row.value) : "none",
                       escaped(row.limit), verdict(row.passed));
  }
  for (const std::string& metric : e.experiment->metrics) {
    const auto& rows = e.result->verdicts;
    const bool shown = std::any_of(rows.begin(), rows.end(),
                                   [&](const VerdictRow& r) { return r.metric == metric; });
    const auto value = e.result->metrics.find(metric);
    if (shown || value == e.result->metrics.end()) continue;
    out += fmt::format("<tr><td>{}</td><td class='n'>{}</td><td></td><td></td></tr>\n", metric,
                       number(metric, value->second));
  }
  return out + "</table></div>\n";
}

/// The same numbers over many seeds.
std::string spreadTable(const ReproducedExperiment& e) {
  const SeedSpread& spread = e.spread;
  if (spread.by_seed.empty()) return "";
  std::string out = fmt::format("<p>Seeds 1 to {0}: {1} of {0} passed.</p>\n",
                                spread.by_seed.size(), spread.passed());
  for (const std::string& line : spread.missed())
    out += fmt::format("<p class='no'>{}</p>\n", escaped(line));
  out +=
      "<div "
      "class='scroll'><table><tr><th>number</th><th>least</th><th>median</th><th>largest</"
      "th><th>limit</th></tr>\n";
  const auto metrics = spread.metrics();
  for (const VerdictRow& row : e.result->verdicts) {
    const auto at = metrics.find(row.metric);
    if (at == metrics.end()) continue;
    out += fmt::format(
        "<tr><td>{0}</td><td class='n'>{1}</td><td class='n'>{2}</td><td "
        "class='n'>{3}</td><td>{4}</td></tr>\n",
        row.metric, number(row.metric, at->second.least), number(row.metric, at->second.median),
        number(row.metric, at->second.largest), escaped(row.limit));
  }
  return out + "</table></div>\n";
}

}  // namespace

std::string reproductionPage(const std::vector<ReproducedExperiment>& experiments,
                             const std::vector<Comparison>& comparisons) {
  std::string out = kHead;
  out +=
      "<div class='scroll'><table><tr><th>experiment</th><th "
      "class='wide'>scenario</th><th>verdict</th><th class='wide'>digest</th></tr>\n";
  for (const ReproducedExperiment& e : experiments) {
    out += fmt::format(
        "<tr><td><a href='#{0}'>{1}</a></td><td class='wide'>{0}</td><td>{2}</td><td "
        "class='wide'><code>{3}</code></td></tr>\n",
        e.experiment->scenario, e.experiment->title, verdict(e.result->passed),
        e.result->trajectory_digest.substr(0, 12));
  }
  out += "</table></div>\n";
  if (!comparisons.empty()) {
    out += "<div class='scroll'><table><tr><th>claim</th><th>measured</th><th></th></tr>\n";
    for (const Comparison& c : comparisons) {
      out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(c.claim),
                         escaped(c.measured), verdict(c.passed));
    }
    out += "</table></div>\n";
  }
  for (const ReproducedExperiment& e : experiments) {
    out += fmt::format("<h2 id='{}'>{}</h2>\n", e.experiment->scenario, e.experiment->title);
    out += fmt::format(
        "<div class='pair'><div><h3>The paper</h3><p>{}</p></div><div><h3>Here: "
        "{}</h3><p>{}{}</p></div></div>\n",
        escaped(e.experiment->paper), verdict(e.result->passed), escaped(e.experiment->here),
        e.result->fell ? fmt::format(" The robot fell at {:.2f} s.", toSeconds(e.result->end))
                       : "");
    out += numbersTable(e) + spreadTable(e);
    out += fmt::format(
        "<div class='scroll'>{}</div>\n<p><a href='{}'>The run's own report</a>, with a replay in "
        "3-D.</p>\n",
        e.figure, e.report_link);
  }
  return out + "</body></html>\n";
}

}  // namespace ballbot
