#include "core/state_visitors.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

void StateLoader::list(std::vector<double>& values) {
  std::vector<double> saved = in_.getVector();
  requireSame(saved.size(), values.size(), "numbers");
  values = std::move(saved);
}

void StateLoader::countUpTo(int capacity, int& count) {
  const int saved = in_.get<int>();
  if (saved < 0 || saved > capacity) {
    refuse(fmt::format("saved {} state: {} values where this one holds up to {}", in_.kind(), saved,
                       capacity));
  }
  count = saved;
}

void StateLoader::requireSame(std::uint64_t saved, std::size_t own, const char* what) const {
  if (saved == own) return;
  refuse(fmt::format("saved {} state: {} {} where this one has {}", in_.kind(), saved, what, own));
}

void StateLoader::refuse(const std::string& words) { throw InputError(words); }

}  // namespace ballbot
