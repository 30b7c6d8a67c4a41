#pragma once

#include <map>
#include <string>
#include <vector>

#include "studies/case_result.hpp"
#include "studies/study_cases.hpp"

namespace ballbot {

/// The results of a study, one row a case in the order of generation; columns have a name, a unit
/// and either numbers (NaN where a case has none) or words.
struct ResultTable {
  struct Column {
    std::string name, unit;
    std::vector<double> numbers;
    std::vector<std::string> words;  ///< instead of numbers
    bool isText() const { return numbers.empty(); }
  };
  std::vector<Column> columns;
  std::size_t rows = 0;

  /// Comma-separated, header "name [unit]"; missing numbers are empty, the others round-trip.
  std::string csv() const;
  /// Of csv(): equal for studies with equal results.
  std::string digest() const;
};

/// Columns: case, seed, one per axis, outcome, reason, simulated_s, every metric any case has, and
/// the trajectory digest. Cases without a result are left out.
ResultTable makeResultTable(const Study& study, const std::vector<StudyCase>& cases,
                            const std::map<std::string, CaseResult>& results);

}  // namespace ballbot
