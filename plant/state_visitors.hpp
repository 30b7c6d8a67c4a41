#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/state_blob.hpp"
#include "core/time.hpp"

namespace ballbot {

// Every class with state names its members once, in visitState(self, visit). What is saved,
// restored and hashed is therefore the same by construction.

/// Writes what it visits into a blob.
class StateSaver {
 public:
  explicit StateSaver(BlobWriter& out) : out_(out) {}
  void operator()(const double& value) { out_.put(value); }
  void operator()(const std::int64_t& value) { out_.put(value); }
  void operator()(const SimTime& value) { out_.put(toNs(value)); }
  void operator()(const std::vector<double>& values) { out_.putVector(values); }
  template <typename Scalar, int Rows>
  void operator()(const Eigen::Matrix<Scalar, Rows, 1>& value) {
    out_.putDoubles(value.data(), Rows);
  }

 private:
  BlobWriter& out_;
};

/// Reads it back, in the same order.
class StateLoader {
 public:
  explicit StateLoader(BlobReader& in) : in_(in) {}
  void operator()(double& value) { value = in_.get<double>(); }
  void operator()(std::int64_t& value) { value = in_.get<std::int64_t>(); }
  void operator()(SimTime& value) { value = simTimeFromNs(in_.get<std::int64_t>()); }
  /// @throw InputError if the saved vector has another length.
  void operator()(std::vector<double>& values) {
    std::vector<double> read = in_.getVector();
    if (read.size() != values.size()) {
      throw InputError(fmt::format("saved plant state: {} numbers where this plant has {}",
                                   read.size(), values.size()));
    }
    values = std::move(read);
  }
  template <typename Scalar, int Rows>
  void operator()(Eigen::Matrix<Scalar, Rows, 1>& value) {
    in_.getDoubles(value.data(), Rows);
  }

 private:
  BlobReader& in_;
};

/// Gathers the bytes for a hash. Keep one and call clear(): it does not allocate again.
class StateHasher {
 public:
  void clear() { bytes_.clear(); }
  std::uint64_t hash() const { return hash64(bytes_.data(), bytes_.size()); }
  void operator()(const double& value) { append(&value, 1); }
  void operator()(const std::int64_t& value) { append(&value, 1); }
  void operator()(const SimTime& value) { (*this)(toNs(value)); }
  void operator()(const std::vector<double>& values) { append(values.data(), values.size()); }
  template <typename Scalar, int Rows>
  void operator()(const Eigen::Matrix<Scalar, Rows, 1>& value) {
    append(value.data(), Rows);
  }

 private:
  template <typename T>
  void append(const T* values, std::size_t count) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
    bytes_.insert(bytes_.end(), bytes, bytes + count * sizeof(T));
  }
  std::vector<std::uint8_t> bytes_;
};

}  // namespace ballbot
