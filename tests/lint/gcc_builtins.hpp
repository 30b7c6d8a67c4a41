// What GCC has built in and clang-tidy's clang has not: declared, for nothing here is run.
#pragma once

template <typename Vector, typename Mask>
Vector __builtin_shuffle(Vector, Mask);  // NOLINT
template <typename Vector, typename Mask>
Vector __builtin_shuffle(Vector, Vector, Mask);  // NOLINT
