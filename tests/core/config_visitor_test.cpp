#include "core/config_visitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config_listing.hpp"
#include "core/error.hpp"
#include "core/key_unit.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

enum class Colour { kRed, kGreen };

struct Wheel {
  double angle = 0.5 * 3.14159265358979323846 / 180;
  void describe(ConfigVisitor& v) {
    v.number(may("angle_deg", "of its axle"), angle, {-90, 90}, 3.14159265358979323846 / 180);
  }
};

struct Toy {
  double mass = 2;
  int doors = 3;
  bool open = false;
  Colour colour = Colour::kGreen;
  SimDuration period{2'500'000};
  std::array<double, 2> size{1, 2};
  std::string name = "toy", file = "toy.stl";
  std::int64_t number = 12;
  Wheel wheel;
  std::vector<Wheel> spares;
  double squared = 0;

  void describe(ConfigVisitor& v) {
    v.number(must("mass_kg", "of all of it"), mass, {kTiny, kInf});
    v.integer(may("doors", "to go through"), doors, {0, 9});
    v.boolean(may("open", "at the start"), open);
    v.choice(may("colour", "of the paint"), colour,
             {{"red", Colour::kRed}, {"green", Colour::kGreen}});
    v.duration(may("period_ms", "from one to the next"), period, {1, 100});
    v.numbers(may("size_m", "length and width"), size.data(), size.size(), {0, 10});
    v.text(may("name", "for people"), name);
    v.fileName(may("file", "its shape"), file);
    v.whole(may("number", "on its sole"), number, {0, kInf});
    v.check([&](const ConfigReader& in) {
      if (size[0] > size[1]) throw InputError(in.at("size_m") + " is longer than it is wide");
    });
    v.section(may("wheel", "one that turns"), [&](ConfigVisitor& in) { wheel.describe(in); });
    v.list(may("spares", "wheels in the boot"), [&](ConfigVisitor& in) {
      spares.emplace_back();
      spares.back().describe(in);
    });
    v.other(may("root", "taken twice"), "a number whose square counts",
            [&](ConfigReader& in) { squared = in.number("root") * in.number("root"); });
  }
};

Toy readToy(const std::string& yaml) {
  const ConfigNode tree = parseYaml(yaml, "toy.yaml");
  ConfigReader in(tree);
  Toy toy;
  readDescribed(in, toy);
  in.finish();
  return toy;
}

std::string errorOf(const std::string& yaml) {
  try {
    readToy(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(ConfigVisitor, ReadsWhatIsThereAndLeavesWhatIsNot) {
  const Toy t = readToy(
      "{mass_kg: 1.5, doors: 4, colour: red, period_ms: 5, size_m: [3, 4], wheel: {angle_deg: 90}, "
      "spares: [{}, {angle_deg: 2}], root: 3, number: 9007199254740991}");
  EXPECT_EQ(t.mass, 1.5);
  EXPECT_EQ(t.doors, 4);
  EXPECT_FALSE(t.open);
  EXPECT_EQ(t.colour, Colour::kRed);
  EXPECT_EQ(t.period, SimDuration{5'000'000});
  EXPECT_EQ(t.size[1], 4);
  EXPECT_EQ(t.name, "toy");
  EXPECT_EQ(t.number, 9007199254740991);
  EXPECT_DOUBLE_EQ(t.wheel.angle, 3.14159265358979323846 / 2);
  ASSERT_EQ(t.spares.size(), 2U);
  EXPECT_DOUBLE_EQ(t.spares[0].angle, Wheel{}.angle);
  EXPECT_EQ(t.squared, 9);
  EXPECT_EQ(readToy("{mass_kg: 1}").colour, Colour::kGreen);
}

TEST(ConfigVisitor, HasTheReadersErrors) {
  EXPECT_THAT(errorOf("{}"), HasSubstr("key 'mass_kg' is missing"));
  EXPECT_THAT(errorOf("{mass_kg: 0}"), HasSubstr("mass_kg"));
  EXPECT_THAT(errorOf("{mass_kg: 1, dors: 3}"), HasSubstr("did you mean 'doors'?"));
  EXPECT_THAT(errorOf("{mass_kg: 1, colour: blue}"), HasSubstr("must be one of: red, green"));
  EXPECT_THAT(errorOf("{mass_kg: 1, wheel: {angel_deg: 3}}"),
              HasSubstr("did you mean 'angle_deg'?"));
  EXPECT_THAT(errorOf("{mass_kg: 1, spares: [{x: 1}]}"),
              HasSubstr("unknown key 'x' in 'spares.0'"));
  EXPECT_THAT(errorOf("{mass_kg: 1, size_m: [1]}"), HasSubstr("must be a list of 2 numbers"));
  EXPECT_THAT(errorOf("{mass_kg: 1, number: 1.5}"), HasSubstr("must be a whole number"));
  EXPECT_THAT(errorOf("{mass_kg: 1, file: ../x}"), HasSubstr("must be the name of a file"));
  EXPECT_THAT(errorOf("{mass_kg: 1, size_m: [2, 1]}"),
              HasSubstr("toy.yaml:1:22: size_m is longer than it is wide"));
}

TEST(ConfigListing, HasEveryKeyWithTypeUnitRangeAndDefault) {
  Toy toy;
  ConfigListing listing("shop.toy");
  toy.describe(listing);
  const std::vector<KeyEntry> keys = listing.take();
  ASSERT_EQ(keys.size(), 14U);
  EXPECT_EQ(keys[0].path, "shop.toy.mass_kg");
  EXPECT_TRUE(keys[0].required);
  EXPECT_EQ(keys[0].unit, "kg");
  EXPECT_EQ(keys[0].fallback, "2");
  EXPECT_EQ(typeText(keys[0]), "number, above 0");
  EXPECT_EQ(typeText(keys[1]), "whole number, 0 to 9");
  EXPECT_EQ(keys[3].fallback, "green");
  EXPECT_EQ(typeText(keys[3]), "one of red, green");
  EXPECT_EQ(keys[4].fallback, "2.5");
  EXPECT_EQ(keys[4].unit, "ms");
  EXPECT_EQ(keys[5].fallback, "[1, 2]");
  EXPECT_EQ(typeText(keys[7]), "text");
  EXPECT_EQ(typeText(keys[8]), "whole number, at least 0");
  EXPECT_EQ(keys[10].path, "shop.toy.wheel.angle_deg");
  EXPECT_EQ(keys[10].fallback, "0.5");
  EXPECT_EQ(keys[12].path, "shop.toy.spares.0.angle_deg");
  EXPECT_EQ(typeText(keys[13]), "a number whose square counts");
}

TEST(KeyUnit, IsWhatTheNameEndsIn) {
  EXPECT_EQ(unitOfKey("spring_stiffness_Nm_per_rad"), "N m/rad");
  EXPECT_EQ(unitOfKey("gravity_m_per_s2"), "m/s^2");
  EXPECT_EQ(unitOfKey("gyro_noise_rad_per_s_per_sqrtHz"), "rad/s/sqrt(Hz)");
  EXPECT_EQ(unitOfKey("largest_tilt_deg"), "deg");
  EXPECT_EQ(unitOfKey("contact_percent"), "%");
  EXPECT_EQ(unitOfKey("seed"), "");
  EXPECT_EQ(unitOfKey("m"), "");
  EXPECT_EQ(unitOfKey("arm_position"), "");
}

}  // namespace
}  // namespace ballbot
