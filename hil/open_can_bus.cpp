#include "hil/open_can_bus.hpp"

#include "core/error.hpp"
#include "hil/slcan_bus.hpp"
#include "hil/socketcan_bus.hpp"

namespace ballbot {

std::unique_ptr<CanBus> openCanBus(const std::string& address, const CanBusSettings& settings) {
  const std::size_t colon = address.find(':');
  const std::string kind = address.substr(0, colon);
  const std::string where = colon == std::string::npos ? "" : address.substr(colon + 1);
  if (!where.empty() && kind == "slcan") return std::make_unique<SlcanBus>(where, settings);
  if (!where.empty() && kind == "socketcan") return std::make_unique<SocketCanBus>(where, settings);
  throw InputError("CAN bus '" + address +
                   "' must be slcan:DEVICE, e.g. slcan:/dev/ttyACM0, or socketcan:INTERFACE, e.g. "
                   "socketcan:can0");
}

}  // namespace ballbot
