#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cosim/stepped.hpp"
#include "fmi/fmu_ports.hpp"

namespace ballbot {

/// One instance of an FMU in this process, FMI 2 or 3 behind one face: values go in and out port by
/// port. It is restored in any state of its life. Whoever calls it lives with
/// what a foreign shared object can do to a process; see fmu_process.hpp.
///
/// All calls throw InputError or NumericalError when the FMU returns an error, with what it logged.
class FmuSlave : public Stepped {
 public:
  virtual void doStep(SimTime now, SimDuration step) = 0;

  /// Of one port; parameters are set before initialisation.
  virtual void get(const FmuPort& port, double* values) = 0;
  virtual void set(const FmuPort& port, const double* values) = 0;
};

/// Loads and instantiates an unpacked FMU. What it says that is no error goes to `say`.
/// @throw InputError if it cannot be loaded or refuses to be instantiated.
std::unique_ptr<FmuSlave> loadFmu(const FmuDescription& fmu, const std::string& folder,
                                  const std::string& instance_name,
                                  std::function<void(const std::string&)> say);

std::unique_ptr<FmuSlave> loadFmi2(const FmuDescription& fmu, const std::string& folder,
                                   const std::string& instance_name,
                                   std::function<void(const std::string&)> say);
std::unique_ptr<FmuSlave> loadFmi3(const FmuDescription& fmu, const std::string& folder,
                                   const std::string& instance_name,
                                   std::function<void(const std::string&)> say);

}  // namespace ballbot
