#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace ballbot {

/// What the solvers ask of a problem's cost, their template argument Cost:
///
/// - `Cost()` is zero, without allocation;
/// - `Cost::kCount` says how many terms it has, at least 1;
/// - `cost.value` is an array of kCount doubles, the terms; continuous time integrates each;
/// - `cost.violation`, a double, says how far the worst inequality is violated, 0 if all hold; it
///   is only reported;
/// - `cost.total()` is what is minimised: the sum of the terms;
/// - `cost += other` adds the terms and takes the larger violation.
///
/// Splitting a cost by term only informs: a problem that does not care takes ScalarCost.
template <typename Cost, typename = void>
struct IsCost : std::false_type {};

template <typename Cost>
struct IsCost<Cost, std::void_t<decltype(Cost::kCount), decltype(std::declval<Cost&>().violation),
                                decltype(std::declval<Cost&>().value[std::size_t{0}]),
                                decltype(std::declval<const Cost&>().total()),
                                decltype(std::declval<Cost&>() += std::declval<const Cost&>())>>
    : std::bool_constant<
          std::is_default_constructible_v<Cost> && (Cost::kCount > 0) &&
          std::is_same_v<decltype(std::declval<Cost&>().value[std::size_t{0}]), double&> &&
          std::is_same_v<decltype(std::declval<Cost&>().violation), double> &&
          std::is_same_v<decltype(std::declval<const Cost&>().total()), double>> {};

}  // namespace ballbot
