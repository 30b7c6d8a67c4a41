#include "core/state_blob.hpp"

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::uint32_t kMagic = 0x62623141;  // "A1bb"

struct Header {
  std::uint32_t magic;
  std::uint32_t version;
  std::uint64_t kind;
  std::uint64_t size;
  std::uint64_t checksum;  // of the body
};

std::uint64_t kindHash(const std::string& kind) { return hash64(kind.data(), kind.size()); }

}  // namespace

void BlobWriter::putBytes(const void* bytes, std::size_t count) {
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  body_.insert(body_.end(), first, first + count);
}

void BlobWriter::putDoubles(const double* values, std::size_t count) {
  putBytes(values, count * sizeof *values);
}

void BlobWriter::putVector(const std::vector<double>& values) {
  put<std::uint64_t>(values.size());
  putDoubles(values.data(), values.size());
}

void BlobWriter::putBlob(const StateBlob& blob) {
  put<std::uint64_t>(blob.size());
  body_.insert(body_.end(), blob.begin(), blob.end());
}

StateBlob BlobWriter::seal(const std::string& kind, std::uint32_t version) const {
  const Header header{kMagic, version, kindHash(kind), body_.size(),
                      hash64(body_.data(), body_.size())};
  StateBlob blob(sizeof header + body_.size());
  std::memcpy(blob.data(), &header, sizeof header);
  if (!body_.empty()) std::memcpy(blob.data() + sizeof header, body_.data(), body_.size());
  return blob;
}

BlobReader::BlobReader(const StateBlob& blob, const std::string& kind, std::uint32_t version)
    : kind_(kind) {
  Header header{};
  if (blob.size() < sizeof header) {
    throw InputError(fmt::format("saved {} state: {} bytes, too short for a header of {}", kind,
                                 blob.size(), sizeof header));
  }
  std::memcpy(&header, blob.data(), sizeof header);
  if (header.magic != kMagic || header.kind != kindHash(kind)) {
    throw InputError(
        fmt::format("saved {} state: these bytes are not a saved {} state", kind, kind));
  }
  if (header.version != version) {
    throw InputError(fmt::format("saved {} state: layout version {}, this program reads version {}",
                                 kind, header.version, version));
  }
  body_.assign(blob.begin() + sizeof header, blob.end());
  if (header.size != body_.size()) {
    throw InputError(fmt::format("saved {} state: {} bytes of content, header says {}", kind,
                                 body_.size(), header.size));
  }
  if (header.checksum != hash64(body_.data(), body_.size())) {
    throw InputError(fmt::format("saved {} state: damaged, its checksum does not match", kind));
  }
}

const std::uint8_t* BlobReader::take(std::size_t size) {
  if (size > body_.size() - position_) {
    throw InputError(fmt::format("saved {} state: wants {} bytes at offset {}, only {} are left",
                                 kind_, size, position_, body_.size() - position_));
  }
  const std::uint8_t* at = body_.data() + position_;
  position_ += size;
  return at;
}

void BlobReader::getDoubles(double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) values[i] = get<double>();
}

std::vector<double> BlobReader::getVector() {
  const auto count = get<std::uint64_t>();
  if (count > (body_.size() - position_) / sizeof(double)) {
    throw InputError(
        fmt::format("saved {} state: a list of {} numbers does not fit", kind_, count));
  }
  std::vector<double> values(count);
  getDoubles(values.data(), values.size());
  return values;
}

StateBlob BlobReader::getBlob() {
  const auto size = get<std::uint64_t>();
  const std::uint8_t* at = take(size);
  return {at, at + size};
}

void BlobReader::finish() const {
  if (position_ != body_.size()) {
    throw InputError(
        fmt::format("saved {} state: {} bytes are left over", kind_, body_.size() - position_));
  }
}

}  // namespace ballbot
