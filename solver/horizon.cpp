#include "solver/horizon.hpp"

#include <cmath>

namespace ballbot {

std::vector<double> Horizon::knots() const {
  const int fine = static_cast<int>(std::lround(fine_length / fine_step));
  const int coarse = static_cast<int>(std::lround((length - fine_length) / coarse_step));
  std::vector<double> out;
  for (int k = 0; k <= fine; ++k) out.push_back(k * fine_step);
  for (int k = 1; k <= coarse; ++k) out.push_back(fine_length + k * coarse_step);
  return out;
}

}  // namespace ballbot
