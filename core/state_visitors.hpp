#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/digest.hpp"
#include "core/state_blob.hpp"
#include "core/time.hpp"

namespace ballbot {

// Every class with state names its members once:
//
//     template <typename Self, typename Visitor>
//     static void visitState(Self& self, Visitor& visit) {
//       visit(self.started_);
//       visit(self.mean_);
//     }
//
// What is saved, restored and hashed is therefore the same by construction.

namespace state_parts {

template <typename T>
constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <typename T>
constexpr bool kIsTime = std::is_same_v<T, SimTime> || std::is_same_v<T, SimDuration>;

/// Of Eigen's matrices of fixed size; -1 of everything else.
template <typename T, typename = void>
constexpr int kFixedSize = -1;
template <typename T>
constexpr int kFixedSize<T, std::void_t<decltype(T::SizeAtCompileTime)>> = T::SizeAtCompileTime;

template <typename T>
constexpr bool kIsRow = false;
template <typename T, std::size_t N>
constexpr bool kIsRow<std::array<T, N>> = true;
template <typename T>
constexpr bool kIsRow<std::vector<T>> = true;

}  // namespace state_parts

/// Takes a state apart down to plain values: numbers, truth values, enumerators, times, Eigen's
/// matrices of fixed size, parts with a visitState() of their own, and arrays and vectors of all
/// these. How long a vector is belongs to the configuration, and only that of a vector of numbers
/// stands in what is saved; sameCount() is for the others. `Actual` says what is done with them.
template <typename Actual>
class StateVisitor {
 public:
  template <typename Part>
  void operator()(Part& part) {
    using T = std::remove_const_t<Part>;
    if constexpr (state_parts::kIsPlain<T>) {
      actual().plain(part);
    } else if constexpr (state_parts::kIsTime<T>) {
      actual().time(part);
    } else if constexpr (state_parts::kFixedSize<T> >= 0) {
      actual().run(part.data(), static_cast<std::size_t>(state_parts::kFixedSize<T>));
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      actual().list(part);
    } else if constexpr (std::is_same_v<T, StateBlob>) {
      actual().blob(part);
    } else if constexpr (state_parts::kIsRow<T>) {
      for (auto& element : part) (*this)(element);
    } else {
      T::visitState(part, actual());
    }
  }

 private:
  Actual& actual() { return static_cast<Actual&>(*this); }
};

/// Writes what it visits into a blob.
class StateSaver : public StateVisitor<StateSaver> {
 public:
  explicit StateSaver(BlobWriter& out) : out_(out) {}

  /// A text by which a loader knows that a saved state is of the same configuration.
  template <typename Refusal>
  void form(const std::string& own, Refusal&&) {
    out_.putBlob(StateBlob(own.begin(), own.end()));
  }
  /// The length of a vector, which is the same where this is loaded.
  void sameCount(std::size_t own, const char*) { out_.put<std::uint64_t>(own); }
  /// How many places of a container of fixed capacity are in use.
  void countUpTo(const int&, const int& count) { out_.put(count); }

 private:
  friend class StateVisitor<StateSaver>;
  template <typename T>
  void plain(const T& value) {
    out_.put(value);
  }
  template <typename T>
  void time(const T& value) {
    out_.put(toNs(value));
  }
  void run(const double* values, std::size_t count) { out_.putDoubles(values, count); }
  void list(const std::vector<double>& values) { out_.putVector(values); }
  void blob(const StateBlob& value) { out_.putBlob(value); }

  BlobWriter& out_;
};

/// Reads it back, in the same order.
class StateLoader : public StateVisitor<StateLoader> {
 public:
  explicit StateLoader(BlobReader& in) : in_(in) {}

  /// @param refusal  makes of the text that was saved the words of an error
  /// @throw InputError if another text was saved.
  template <typename Refusal>
  void form(const std::string& own, Refusal&& refusal) {
    const StateBlob bytes = in_.getBlob();
    const std::string saved(bytes.begin(), bytes.end());
    if (saved != own) refuse(refusal(saved));
  }
  /// @throw InputError if another length was saved. @param what  that is counted, for its words
  void sameCount(std::size_t own, const char* what) {
    requireSame(in_.get<std::uint64_t>(), own, what);
  }
  /// @throw InputError if what was saved is negative or does not fit.
  void countUpTo(int capacity, int& count);

 private:
  friend class StateVisitor<StateLoader>;
  template <typename T>
  void plain(T& value) {
    value = in_.get<T>();
  }
  void plain(bool& value) { value = in_.get<std::uint8_t>() != 0; }
  template <typename T>
  void time(T& value) {
    value = T(SimDuration(in_.get<std::int64_t>()));
  }
  void run(double* values, std::size_t count) { in_.getDoubles(values, count); }
  /// @throw InputError if the saved vector has another length.
  void list(std::vector<double>& values);
  void blob(StateBlob& value) { value = in_.getBlob(); }

  void requireSame(std::uint64_t saved, std::size_t own, const char* what) const;
  [[noreturn]] static void refuse(const std::string& words);

  BlobReader& in_;
};

/// Gathers the bytes for a hash. Keep one and call clear(): it does not allocate again.
class StateHasher : public StateVisitor<StateHasher> {
 public:
  void clear() { bytes_.clear(); }
  std::uint64_t hash() const { return hash64(bytes_.data(), bytes_.size()); }

  /// Of the configuration, not of the state.
  template <typename Refusal>
  void form(const std::string&, Refusal&&) {}

 private:
  friend class StateVisitor<StateHasher>;
  template <typename T>
  void plain(const T& value) {
    append(&value, 1);
  }
  template <typename T>
  void time(const T& value) {
    plain(toNs(value));
  }
  void run(const double* values, std::size_t count) { append(values, count); }
  void list(const std::vector<double>& values) { append(values.data(), values.size()); }

  template <typename T>
  void append(const T* values, std::size_t count) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
    bytes_.insert(bytes_.end(), bytes, bytes + count * sizeof(T));
  }
  std::vector<std::uint8_t> bytes_;
};

/// @param kind  what is saved ("plant"), @param version  of its layout
/// @param visiting  is called with a visitor, for all of the state
template <typename Visiting>
StateBlob sealState(const std::string& kind, std::uint32_t version, Visiting&& visiting) {
  BlobWriter out;
  StateSaver saver(out);
  visiting(saver);
  return out.seal(kind, version);
}

/// The same way back. Where this throws, part of the state may have been read.
/// @throw InputError as BlobReader and StateLoader.
template <typename Visiting>
void openState(const StateBlob& blob, const std::string& kind, std::uint32_t version,
               Visiting&& visiting) {
  BlobReader in(blob, kind, version);
  StateLoader loader(in);
  visiting(loader);
  in.finish();
}

template <typename T>
StateBlob saveStateOf(const T& object, const std::string& kind, std::uint32_t version) {
  return sealState(kind, version, [&](StateSaver& visit) { visit(object); });
}

/// @throw InputError as openState(); `object` is then as it was.
template <typename T>
void restoreStateOf(T& object, const StateBlob& blob, const std::string& kind,
                    std::uint32_t version) {
  T next = object;
  openState(blob, kind, version, [&](StateLoader& visit) { visit(next); });
  object = std::move(next);
}

}  // namespace ballbot
