#include "core/config_visitor.hpp"

#include "core/config_values.hpp"

namespace ballbot {

void ConfigReading::number(const ConfigKey& key, double& value, Range range, double scale) {
  if (key.required) {
    value = scale * in_.number(key.name, range);
  } else {
    value = scale * in_.numberOr(key.name, value / scale, range);
  }
}

void ConfigReading::integer(const ConfigKey& key, int& value, Range range) {
  if (!absent(key)) value = in_.integer(key.name, range);
}

void ConfigReading::whole(const ConfigKey& key, std::int64_t& value, Range range) {
  if (!absent(key)) value = readWhole(in_, key.name, range);
}

void ConfigReading::boolean(const ConfigKey& key, bool& value) {
  if (!absent(key)) value = in_.boolean(key.name);
}

void ConfigReading::text(const ConfigKey& key, std::string& value) {
  if (!absent(key)) value = in_.text(key.name);
}

void ConfigReading::fileName(const ConfigKey& key, std::string& value) {
  if (!absent(key)) value = readFileName(in_, key.name);
}

void ConfigReading::duration(const ConfigKey& key, SimDuration& value, Range range) {
  if (!absent(key)) value = in_.duration(key.name, range);
}

void ConfigReading::numbers(const ConfigKey& key, double* values, std::size_t count, Range range,
                            double scale) {
  if (absent(key)) return;
  in_.numbers(key.name, values, count, range);
  for (std::size_t i = 0; i < count; ++i) values[i] *= scale;
}

void ConfigReading::section(const ConfigKey& key,
                            const std::function<void(ConfigVisitor&)>& inner) {
  if (absent(key)) return;
  ConfigReader child = in_.child(key.name);
  ConfigReading reading(child);
  inner(reading);
  child.finish();
}

void ConfigReading::list(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) {
  if (absent(key)) return;
  for (ConfigReader& item : in_.list(key.name)) {
    ConfigReading reading(item);
    inner(reading);
    item.finish();
  }
}

void ConfigReading::other(const ConfigKey& key, const char*,
                          const std::function<void(ConfigReader&)>& read) {
  if (!absent(key)) read(in_);
}

void ConfigReading::chooseIndex(const ConfigKey& key, std::size_t& index,
                                const std::vector<std::string>& names) {
  if (!absent(key)) index = in_.chooseIndex(key.name, names);
}

}  // namespace ballbot
