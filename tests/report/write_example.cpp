// Usage: report_example OUT.html [replay|no-replay|failed]
// Writes the example run's page, for the tests of the page and for people who work on it.
#include <iostream>
#include <string>

#include "report/write_report.hpp"
#include "tests/report/example_run.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "Usage: report_example OUT.html [replay|no-replay|failed]\n";
    return 2;
  }
  const std::string kind = argc > 2 ? argv[2] : "replay";
  ballbot::ReportData data = ballbot::exampleRun();
  if (kind == "no-replay") data.replay.reset();
  if (kind == "failed") {
    data.passed = false;
    data.verdict = "1 of 3 requirements missed";
    data.requirements.back().limit = "< 0.0001";
    data.requirements.back().passed = false;
  }
  ballbot::writeReport(data, ballbot::exampleUrdf(), argv[1]);
}
