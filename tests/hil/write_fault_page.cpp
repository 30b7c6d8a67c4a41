// Usage: fault_page_example OUT.html
// Writes the page of a rehearsed fault, for the tests of the page and for people who work on it.
#include <iostream>

#include "hil/record/fault_page.hpp"
#include "report/write_report.hpp"
#include "tests/hil/support/rehearsed_record.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "Usage: fault_page_example OUT.html\n";
    return 2;
  }
  const ballbot::RehearsedRecord run(ballbot::RunnerKind::kStepped, [](ballbot::Rehearsal& r) {
    r.drives().inject({0, ballbot::EmulatedFault::kImuLost, 0, 0});
  });
  ballbot::writeReport(ballbot::faultPage(run.record()), "", argv[1]);
}
