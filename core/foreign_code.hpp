#pragma once

#include <exception>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace ballbot {

/// Does work that somebody added to the program: a law's, a sensor's. What it throws that is no
/// Error becomes one that says whose it is.
/// @throw Error
template <typename Work>
auto doneBy(const std::string& whose, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(whose + ": " + e.what());
  }
}

}  // namespace ballbot
