#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace ballbot {

/// Bytes of a saved state that mean the same in every process of this program on this kind of
/// machine: no pointers, with kind, version, size and checksum.
using StateBlob = std::vector<std::uint8_t>;

/// Writes plain values one after the other; seal() adds the header and the checksum.
class BlobWriter {
 public:
  BlobWriter() { body_.reserve(4096); }  // as much as most states take: grown once at most

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "plain values only");
    putBytes(&value, sizeof value);
  }
  void putDoubles(const double* values, std::size_t count);
  /// A length, then the values.
  void putVector(const std::vector<double>& values);
  void putBlob(const StateBlob& blob);

  /// @param kind what wrote this ("plant"), @param version of its layout.
  StateBlob seal(const std::string& kind, std::uint32_t version) const;

 private:
  // Not inline: GCC 12 takes a vector that grows by one integer for one that is written past its
  // end.
  void putBytes(const void* bytes, std::size_t count);

  std::vector<std::uint8_t> body_;
};

/// Reads what BlobWriter wrote, in the same order.
class BlobReader {
 public:
  /// @throw InputError if the blob is of another kind or version, cut short, or damaged.
  BlobReader(const StateBlob& blob, const std::string& kind, std::uint32_t version);

  template <typename T>
  T get() {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "plain values only");
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  void getDoubles(double* values, std::size_t count);
  std::vector<double> getVector();
  StateBlob getBlob();
  /// What the blob is of, for words about it.
  const std::string& kind() const { return kind_; }
  /// @throw InputError if bytes are left over.
  void finish() const;

 private:
  const std::uint8_t* take(std::size_t size);

  std::string kind_;
  std::vector<std::uint8_t> body_;
  std::size_t position_ = 0;
};

}  // namespace ballbot
