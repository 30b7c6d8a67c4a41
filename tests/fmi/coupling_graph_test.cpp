#include "fmi/coupling_graph.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CouplingPort port(const std::string& name, std::size_t size = 1, const char* unit = "m",
                  std::vector<std::size_t> depends_on = {}) {
  CouplingPort p;
  p.name = name;
  p.size = size;
  if (*unit != '\0') p.unit = fmuUnit(unit);
  p.depends_on = std::move(depends_on);
  return p;
}

/// A model with input `in` and output `out`, which follows from the input at once if `through`.
CouplingNode model(const std::string& name, bool through) {
  CouplingNode node{name, {}, {}};
  CouplingNode::add(node.inputs, port("in"));
  CouplingNode::add(node.outputs, through ? port("out", 1, "m", {0}) : port("out"));
  return node;
}

CouplingLine line(const std::string& from, const std::string& to, bool delayed = false) {
  return {from, to, delayed, {"s.yaml", 7, 3}};
}

std::string refusal(std::vector<CouplingNode> nodes, const std::vector<CouplingLine>& lines) {
  try {
    CouplingGraph(std::move(nodes), lines);
  } catch (const InputError& e) {
    return e.what();
  }
  return "not refused";
}

TEST(CouplingGraph, EvaluatesWhatFollowsAtOnceAfterWhatItFollowsFrom) {
  // c <- b <- a, declared the other way round; d holds its output.
  const CouplingGraph graph(
      {model("c", true), model("b", true), model("a", true), model("d", false)},
      {line("b.out", "c.in"), line("a.out", "b.in"), line("d.out", "a.in"), line("c.out", "d.in")});
  EXPECT_THAT(graph.beforeController(), ElementsAre(2U, 1U, 0U));
  EXPECT_THAT(graph.afterController(), IsEmpty());
}

TEST(CouplingGraph, WhatFollowsFromTheControllerComesAfterIt) {
  const CouplingGraph graph({model("plant", false), model("drive", true), model("sensor", true),
                             model("controller", true)},
                            {line("plant.out", "sensor.in"), line("sensor.out", "controller.in"),
                             line("controller.out", "drive.in"), line("drive.out", "plant.in")});
  EXPECT_THAT(graph.beforeController(), ElementsAre(2U));
  EXPECT_THAT(graph.afterController(), ElementsAre(1U));
}

TEST(CouplingGraph, ALoopWithinOneInstantIsRefusedUnlessOneConnectionIsDelayed) {
  const std::vector<CouplingNode> nodes = {model("a", true), model("b", true), model("c", true)};
  const std::vector<CouplingLine> loop = {line("a.out", "b.in"), line("b.out", "c.in"),
                                          line("c.out", "a.in")};
  EXPECT_THAT(refusal(nodes, loop), HasSubstr("a.out -> b.out -> c.out -> a.out"));
  EXPECT_THAT(refusal(nodes, loop), HasSubstr("'delay_steps: 1'"));
  std::vector<CouplingLine> broken = loop;
  broken[1].delayed = true;
  EXPECT_THAT(CouplingGraph(nodes, broken).beforeController(), ElementsAre(2U, 0U, 1U));
}

TEST(CouplingGraph, ALoopThroughTheControllerIsOneToo) {
  EXPECT_THAT(refusal({model("plant", true), model("controller", true)},
                      {line("plant.out", "controller.in"), line("controller.out", "plant.in")}),
              HasSubstr("depend on each other within one instant"));
}

TEST(CouplingGraph, DelayedConnectionsCarryTheValuesOfTheStepBefore) {
  const CouplingGraph graph({model("a", false), model("b", false)},
                            {line("a.out", "b.in", true), line("b.out", "a.in")});
  std::vector<double> inputs(1);
  graph.gather(1, {{5}, {6}}, {{3}, {4}}, inputs);
  EXPECT_EQ(inputs[0], 3);
  graph.gather(0, {{5}, {6}}, {{3}, {4}}, inputs);
  EXPECT_EQ(inputs[0], 6);
}

TEST(CouplingGraph, ElementsOfRowsConnectOneByOne) {
  CouplingNode row{"row", {}, {}};
  CouplingNode::add(row.outputs, port("x"));
  CouplingNode::add(row.outputs, port("p", 3));
  const CouplingGraph graph({row, model("a", false)}, {line("row.p[2]", "a.in")});
  std::vector<double> inputs(1);
  graph.gather(1, {{1, 20, 21, 22}, {0}}, {{}, {}}, inputs);
  EXPECT_EQ(inputs[0], 21);
  EXPECT_THAT(refusal({row, model("a", false)}, {line("row.p[4]", "a.in")}),
              HasSubstr("has no output 'p[4]'"));
}

TEST(CouplingGraph, SaysWhatDoesNotFit) {
  const std::vector<CouplingNode> nodes = {model("door", false), model("plant", false)};
  EXPECT_THAT(refusal(nodes, {line("dor.out", "plant.in")}),
              HasSubstr("s.yaml:7:3: 'dor.out' names no participant; there are: door, plant"));
  EXPECT_THAT(refusal(nodes, {line("door.outt", "plant.in")}),
              HasSubstr("'door' has no output 'outt'; did you mean 'door.out'?"));
  EXPECT_THAT(refusal(nodes, {line("door.in", "plant.in")}), HasSubstr("has no output 'in'"));
  EXPECT_THAT(refusal(nodes, {line("door.out", "plant.in"), line("plant.out", "plant.in")}),
              HasSubstr("'plant.in' has another source already"));

  CouplingNode angle{"angle", {}, {}}, wide{"wide", {}, {}}, plain{"plain", {}, {}};
  CouplingNode::add(angle.inputs, port("in", 1, "rad"));
  CouplingNode::add(wide.inputs, port("in", 3));
  CouplingNode::add(plain.inputs, port("in", 1, ""));
  EXPECT_THAT(refusal({nodes[0], angle}, {line("door.out", "angle.in")}),
              HasSubstr("'door.out' is in m, but 'angle.in' in rad"));
  EXPECT_THAT(refusal({nodes[0], wide}, {line("door.out", "wide.in")}),
              HasSubstr("'door.out' has 1 values, 'wide.in' takes 3"));
  EXPECT_EQ(refusal({nodes[0], plain}, {line("door.out", "plain.in")}), "not refused")
      << "no unit said, none compared";
}

}  // namespace
}  // namespace ballbot
