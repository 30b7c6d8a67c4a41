#pragma once

#include <string>

#include "report/report_data.hpp"

namespace ballbot {

/// A run as a report shows it, for tests of the report and of its page: ten seconds of a ball with
/// an upper body, a planar pendulum along x and another along y (nonlinear, decoupled), balanced
/// by state feedback. It is pushed along y at 2 s and along x at 5 s; the second push drives the
/// end-effector against a springy wall. Measured lines carry seeded noise.
ReportData exampleRun();

/// The robot that the example's joints and links belong to.
std::string exampleUrdf();

}  // namespace ballbot
