#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "experiment/log_tables.hpp"
#include "report/write_report.hpp"

namespace ballbot {

/// Adds lines from the columns of recorded tables to one pair of axes.
class AxesBuilder {
 public:
  AxesBuilder(const std::vector<LogTable>& tables, std::string quantity, std::string unit,
              double scale = 1)
      : tables_(tables), scale_(scale) {
    axes_.quantity = std::move(quantity);
    axes_.unit = std::move(unit);
  }
  AxesBuilder& line(const std::string& table, const std::string& column, const std::string& name,
                    SeriesStyle style, int channel) {
    if (const LogTable* t = findTable(tables_, table)) {
      PlotSeries series{name, style, channel, t->column("time_s"), t->column(column)};
      for (double& v : series.values) v *= scale_;
      axes_.series.push_back(std::move(series));
    }
    return *this;
  }
  /// The same of its size.
  AxesBuilder& size(const std::string& table, const std::string& column, const std::string& name,
                    SeriesStyle style, int channel) {
    const std::size_t before = axes_.series.size();
    line(table, column, name, style, channel);
    if (axes_.series.size() == before) return *this;
    for (double& v : axes_.series.back().values) v = std::abs(v);
    return *this;
  }
  AxesBuilder& limit(const std::string& name, double value) {
    axes_.limits.push_back({name, value});
    axes_.limits.push_back({"", -value});
    return *this;
  }
  const PlotAxes& axes() const { return axes_; }

 private:
  const std::vector<LogTable>& tables_;
  double scale_;
  PlotAxes axes_;
};

/// A column of the truth and the same of the estimate.
inline void addBoth(AxesBuilder& axes, const std::string& column, const std::string& name,
                    int channel) {
  axes.line("truth", column, name + " true", SeriesStyle::kMeasured, channel)
      .line("estimate", column, name + " estimated", SeriesStyle::kEstimated, channel);
}

}  // namespace ballbot
