#pragma once

#include <string>
#include <vector>

#include "fmi/coupling_config.hpp"
#include "fmi/fmu_types.hpp"
#include "fmi/units.hpp"

namespace ballbot {

/// One named run of values in a participant's row of inputs or outputs.
struct CouplingPort {
  std::string name;                  ///< without the participant's
  std::vector<std::string> aliases;  ///< other names that connections may use
  FmuUnit unit;                      ///< name empty: nobody said
  ValueKind kind = ValueKind::kReal;
  std::size_t offset = 0, size = 0;
  std::vector<std::size_t> dimensions;  ///< of arrays of more than one
  std::size_t first_index = 1;          ///< number of the first element
  /// Of outputs: the inputs, by their number, on which they depend within one instant.
  std::vector<std::size_t> depends_on;
};

/// A participant, as connections see it.
struct CouplingNode {
  std::string name;
  std::vector<CouplingPort> inputs, outputs;

  std::size_t inputSize() const;
  std::size_t outputSize() const;
  /// Appends; the offset is counted here.
  static void add(std::vector<CouplingPort>& ports, CouplingPort port);
};

/// Who gets which values from whom, and in which order the values of one instant follow from one
/// another. The order depends on the scenario alone.
class CouplingGraph {
 public:
  /// @param nodes named; the one named `controller` decides what is known before and after it
  /// @throw InputError with file, line and column for unknown names, different units or sizes,
  ///        kinds of values that would lose something, two sources of one value, and loops within
  ///        one instant without a delay.
  CouplingGraph(std::vector<CouplingNode> nodes, const std::vector<CouplingLine>& lines);

  const std::vector<CouplingNode>& nodes() const { return nodes_; }
  std::size_t find(const std::string& name) const;

  /// Fills a node's row of inputs from the outputs of all, and from those of one step before.
  void gather(std::size_t node, const std::vector<std::vector<double>>& outputs,
              const std::vector<std::vector<double>>& before, std::vector<double>& inputs) const;
  /// Nodes whose outputs follow from inputs at once, to be evaluated in this order when time has
  /// advanced; and those that have to wait for what the controller says.
  const std::vector<std::size_t>& beforeController() const { return before_; }
  const std::vector<std::size_t>& afterController() const { return after_; }

  /// Whether every value of this input comes from somewhere; and whether any goes somewhere.
  bool fed(std::size_t node, const CouplingPort& input) const;
  bool used(std::size_t node, const CouplingPort& output) const;

 private:
  struct Copy {
    std::size_t from_node, from, to_node, to, size;
    bool delayed;
  };
  struct Output {
    std::size_t node, port;
  };
  void connect(const CouplingLine& line);
  bool acts(const Output& a, const Output& b) const;
  bool awaited(const Output& output) const;
  void order();
  [[noreturn]] void refuseLoop(const std::vector<Output>& outputs,
                               const std::vector<char>& done) const;

  std::vector<CouplingNode> nodes_;
  std::vector<Copy> copies_;
  std::vector<std::size_t> before_, after_;
};

}  // namespace ballbot
