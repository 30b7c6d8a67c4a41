#pragma once

#include <string>

#include <gtest/gtest.h>

namespace ballbot::testing_support {

/// What an exception of this kind says; a test failure if none comes.
template <typename Exception, typename Work>
std::string wordsOf(Work&& work) {
  try {
    work();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

}  // namespace ballbot::testing_support
