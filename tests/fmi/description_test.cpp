// The model description and the archive, by the rules of the standard.
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <tinyxml2.h>

#include "fmi/fmu_export.hpp"
#include "fmi/zip_archive.hpp"
#include "tests/fmi/fmu_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using tinyxml2::XMLElement;

std::string readFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class DescriptionTest : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    ASSERT_EQ(document.Parse(readFromZip(fmu.file, "modelDescription.xml", 1U << 20).c_str()),
              tinyxml2::XML_SUCCESS);
    root = document.FirstChildElement("fmiModelDescription");
    ASSERT_NE(root, nullptr);
  }
  std::vector<const XMLElement*> children(const XMLElement* parent,
                                          const char* name = nullptr) const {
    std::vector<const XMLElement*> out;
    for (const XMLElement* e = parent->FirstChildElement(name); e; e = e->NextSiblingElement(name))
      out.push_back(e);
    return out;
  }
  std::vector<const XMLElement*> variables() const {
    return children(root->FirstChildElement("ModelVariables"));
  }
  bool two() const { return GetParam() == 2; }

  const UnpackedFmu& fmu = unpackedFmu(GetParam());
  tinyxml2::XMLDocument document;
  const XMLElement* root = nullptr;
};

TEST_P(DescriptionTest, ElementsStandInTheOrderOfTheSchema) {
  std::vector<std::string> names;
  for (const XMLElement* e : children(root)) names.push_back(e->Name());
  EXPECT_EQ(names, (std::vector<std::string>{"CoSimulation", "UnitDefinitions", "TypeDefinitions",
                                             "LogCategories", "DefaultExperiment", "ModelVariables",
                                             "ModelStructure"}));
}

TEST_P(DescriptionTest, NamesReferencesUnitsAndTypesAreDefinedOnce) {
  std::set<std::string> names, units, types;
  std::set<unsigned> references;
  for (const XMLElement* u : children(root->FirstChildElement("UnitDefinitions")))
    units.insert(u->Attribute("name"));
  for (const XMLElement* t : children(root->FirstChildElement("TypeDefinitions")))
    types.insert(t->Attribute("name"));
  for (const XMLElement* v : variables()) {
    EXPECT_TRUE(names.insert(v->Attribute("name")).second) << v->Attribute("name");
    EXPECT_TRUE(references.insert(v->UnsignedAttribute("valueReference")).second);
    EXPECT_GT(std::string(v->Attribute("description")).size(), 3U) << v->Attribute("name");
    const XMLElement* type = two() ? v->FirstChildElement() : v;
    if (const char* unit = type->Attribute("unit")) {
      EXPECT_EQ(units.count(unit), 1U) << unit;
    }
    // A number without a unit says so, with unit "1": none is not the same as forgotten.
    const std::string kind = two() ? type->Name() : v->Name();
    EXPECT_EQ(type->Attribute("unit") != nullptr, kind == "Real" || kind == "Float64")
        << v->Attribute("name");
    if (const char* declared = type->Attribute("declaredType")) {
      EXPECT_EQ(types.count(declared), 1U) << declared;
    }
  }
  EXPECT_GT(names.size(), 60U);
}

TEST_P(DescriptionTest, StartInitialAndVariabilityStandWhereTheStandardHasThem) {
  int independent = 0;
  for (const XMLElement* v : variables()) {
    const std::string causality = v->Attribute("causality"), name = v->Attribute("name");
    const std::string variability = v->Attribute("variability"),
                      type = two() ? v->FirstChildElement()->Name() : v->Name();
    const bool start = (two() ? v->FirstChildElement() : v)->Attribute("start") != nullptr;
    const std::string initial = v->Attribute("initial") ? v->Attribute("initial") : "";
    EXPECT_EQ(start, causality == "input" || causality == "parameter") << name;
    EXPECT_EQ(initial, causality == "parameter"                        ? "exact"
                       : causality == "output" || causality == "local" ? "calculated"
                                                                       : "")
        << name;
    if (causality == "parameter") {
      EXPECT_EQ(variability, "fixed") << name;
    }
    if (variability == "continuous") {
      EXPECT_TRUE(type == "Real" || type == "Float64") << name;
    }
    if (causality == "independent") {
      ++independent;
      EXPECT_EQ(name, "time");
    }
  }
  EXPECT_EQ(independent, 1);
}

// Outputs: each, and without dependence on inputs of its own time. Initial unknowns: the outputs,
// as they are calculated; locals are none, as nothing here is a state that the importer knows of.
TEST_P(DescriptionTest, StructureNamesExactlyTheOutputs) {
  std::set<unsigned> outputs, listed, unknowns, parameters;
  unsigned index = 0;
  for (const XMLElement* v : variables()) {
    const unsigned id = two() ? ++index : v->UnsignedAttribute("valueReference");
    if (std::string(v->Attribute("causality")) == "output") outputs.insert(id);
    if (std::string(v->Attribute("causality")) == "parameter") parameters.insert(id);
  }
  const XMLElement* structure = root->FirstChildElement("ModelStructure");
  const char* key = two() ? "index" : "valueReference";
  const auto out = two() ? children(structure->FirstChildElement("Outputs"), "Unknown")
                         : children(structure, "Output");
  const auto initial = two() ? children(structure->FirstChildElement("InitialUnknowns"), "Unknown")
                             : children(structure, "InitialUnknown");
  for (const XMLElement* e : out) {
    EXPECT_TRUE(listed.insert(e->UnsignedAttribute(key)).second);
    EXPECT_STREQ(e->Attribute("dependencies"), "");
  }
  for (const XMLElement* e : initial) {
    EXPECT_TRUE(unknowns.insert(e->UnsignedAttribute(key)).second);
    std::istringstream dependencies(e->Attribute("dependencies"));
    std::set<unsigned> on;
    for (unsigned id; dependencies >> id;) on.insert(id);
    EXPECT_EQ(on, parameters);
  }
  EXPECT_EQ(listed, outputs);
  EXPECT_EQ(unknowns, outputs);
  EXPECT_GT(outputs.size(), 8U);
}

TEST_P(DescriptionTest, CapabilitiesAreSaidAsTheyAre) {
  const XMLElement* c = root->FirstChildElement("CoSimulation");
  EXPECT_STREQ(c->Attribute("modelIdentifier"), "ballbot_plant");
  EXPECT_TRUE(c->BoolAttribute("canHandleVariableCommunicationStepSize"));
  EXPECT_TRUE(c->BoolAttribute(two() ? "canGetAndSetFMUstate" : "canGetAndSetFMUState"));
  EXPECT_TRUE(c->BoolAttribute(two() ? "canSerializeFMUstate" : "canSerializeFMUState"));
  EXPECT_FALSE(c->BoolAttribute("needsExecutionTool", true));
  EXPECT_FALSE(c->BoolAttribute("canBeInstantiatedOnlyOncePerProcess", true));
  EXPECT_EQ(root->FirstChildElement("DefaultExperiment")->DoubleAttribute("stopTime"), 10);
}

TEST_P(DescriptionTest, XmllintFindsItWellFormed) {
  EXPECT_EQ(std::system(("xmllint --noout '" + fmu.folder + "/modelDescription.xml'").c_str()), 0);
}

TEST_P(DescriptionTest, EqualExportsGiveEqualBytesAndHoldWhatIsNeeded) {
  FmuExport how;
  how.fmi_version = GetParam();
  how.program_version = "0.0.0";
  how.libraries_folder = BALLBOT_BIN_DIR "/../lib/ballbot/fmu";
  const std::string again = fmu.folder + ".again";
  exportFmu(testScenario(), testUrdf(), how, again);
  EXPECT_TRUE(readFile(again) == readFile(fmu.file));
  for (const char* name : {"resources/scenario.yaml", "resources/robot.urdf",
                           "documentation/index.html", "documentation/licenses/license.txt"}) {
    EXPECT_TRUE(zipHas(fmu.file, name)) << name;
  }
  EXPECT_TRUE(fmu.description.has_binary);
}

TEST_P(DescriptionTest, OurImporterReadsWhatWeWrote) {
  const FmuDescription& d = fmu.description;
  EXPECT_EQ(d.fmi_version, GetParam());
  EXPECT_TRUE(d.saves_state && d.variable_steps && !d.needs_execution_tool);
  EXPECT_EQ(findPort(d, "command.torque").size, 6);
  EXPECT_EQ(findPort(d, "command.torque").first().unit, "N m");
  EXPECT_FALSE(findPort(d, "sensors.accel_B").first().depends_on_all);
  EXPECT_THAT(messageOf([&] { findPort(d, "sensors.acel_B"); }),
              HasSubstr("did you mean 'sensors.accel_B"));
}

INSTANTIATE_TEST_SUITE_P(Fmi, DescriptionTest, ::testing::Values(2, 3),
                         [](const auto& version) { return std::to_string(version.param); });

TEST(Export, SaysWhatIsWrong) {
  FmuExport how;
  how.libraries_folder = "/nowhere";
  EXPECT_THAT(messageOf([&] { exportFmu(testScenario(), testUrdf(), how, "/tmp/x.fmu"); }),
              HasSubstr("/nowhere/fmi2: there is no ballbot_plant.so"));
  how.libraries_folder = BALLBOT_BIN_DIR "/../lib/ballbot/fmu";
  EXPECT_THAT(messageOf([&] { exportFmu(testScenario(), testUrdf(), how, "/nowhere/x.fmu"); }),
              HasSubstr("/nowhere/x.fmu: cannot be written"));
  ConfigNode coupled = testScenario();
  coupled.set("fmus", ConfigNode::list({}));
  EXPECT_THAT(messageOf([&] { exportFmu(coupled, testUrdf(), how, "/tmp/x.fmu"); }),
              HasSubstr("the scenario has FMUs of its own"));
  ConfigNode scenario = testScenario();
  scenario.set("seed", ConfigNode::scalar("5000000000", false, {}));
  EXPECT_THAT(messageOf([&] { exportFmu(scenario, testUrdf(), how, "/tmp/x.fmu"); }),
              HasSubstr("'seed' is 5000000000, but FMI 2 has 32-bit integers only"));
}

TEST(Import, SaysWhatAFileIsNot) {
  EXPECT_THAT(messageOf([] { readFmuDescription(testUrdf()); }),
              HasSubstr("is not an archive that can be read"));
  EXPECT_THAT(messageOf([] { readFmuDescription("/nowhere.fmu"); }),
              HasSubstr("/nowhere.fmu: is not an archive"));
}

}  // namespace
}  // namespace ballbot
