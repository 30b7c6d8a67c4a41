#pragma once

#include <cstdint>
#include <string>

#include "hil/bench_config.hpp"
#include "hil/sdo_client.hpp"

namespace ballbot {

/// Name of an object as CiA 301, CiA 402 or the emulated devices have it; "" if it is none of those
/// that a bench uses.
const char* nameOf(ObjectAddress object) noexcept;

/// An object with its value: "6077:00 torque 0.52 Nm". Little endian bytes, 1 to 8 of them.
/// @param drive  whose scaling gives the unit; null: the value stays a number
std::string objectText(ObjectAddress object, const std::uint8_t* bytes, std::size_t size,
                       const DriveConfig* drive);

/// What a controlword (6040) asks for: "enable operation".
const char* controlwordText(std::uint16_t word) noexcept;

}  // namespace ballbot
