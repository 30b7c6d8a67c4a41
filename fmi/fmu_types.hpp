#pragma once

#include <string>

namespace ballbot {

/// What a connection has to know of a value to carry it without loss.
enum class ValueKind {
  kReal,
  kInteger,
  kBoolean,
  kEnumeration,
  kOther,  ///< text, bytes, clocks: nothing that a connection carries
};

/// The form in which an FMU's functions take and give a value.
enum class NativeType {
  kFloat32,
  kFloat64,
  kInt8,
  kUInt8,
  kInt16,
  kUInt16,
  kInt32,
  kUInt32,
  kInt64,
  kUInt64,
  kBoolean,
  kNone,
};

/// One type of FMI 2 or 3.
struct FmuType {
  const char* name;  ///< as model descriptions write it
  ValueKind kind;
  NativeType native;
  /// Numbers it holds. Those beyond 2^53 are left out, as a connection's doubles would round them.
  double low, high;
};

/// @return the type of that name, or one of kind kOther
const FmuType& fmuType(const std::string& name);

/// "a real number", "true or false", ...
const char* toText(ValueKind kind);

/// Whether every value of an output of kind `from` can be given to an input of kind `to`. That a
/// whole number fits into a smaller integer is seen when it comes.
bool fitsWithoutLoss(ValueKind from, ValueKind to);

}  // namespace ballbot
