#pragma once

#include <map>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <tinyxml2.h>

#include "model/frames.hpp"
#include "model/state.hpp"

namespace ballbot {

/// The same robot as a CAD exporter would write it: every link's frame turned by its own rotation.
/// Mass, place and motion are the same.
class TurnedUrdf {
 public:
  explicit TurnedUrdf(const std::string& text) { document_.Parse(text.c_str(), text.size()); }

  /// Takes coordinates in the link's new frame to those in its old one. Not for the root.
  void turn(const std::string& link, const Matrix3& R) { R_[link] = R; }

  std::string text() {
    auto* robot = document_.RootElement();
    for (auto* e = robot->FirstChildElement("link"); e; e = e->NextSiblingElement("link")) {
      const Matrix3 R = of(e->Attribute("name")).transpose();
      for (auto* part = e->FirstChildElement(); part; part = part->NextSiblingElement()) {
        write(*part, {R * xyz(*part), R * rotation(*part)});
      }
    }
    for (auto* e = robot->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      const Matrix3 R_P = of(e->FirstChildElement("parent")->Attribute("link")).transpose();
      const Matrix3 R_C = of(e->FirstChildElement("child")->Attribute("link"));
      write(*e, {R_P * xyz(*e), R_P * rotation(*e) * R_C});
      if (auto* axis = e->FirstChildElement("axis")) {
        axis->SetAttribute("xyz", three(R_C.transpose() * vector(*axis, "xyz")).c_str());
      }
    }
    tinyxml2::XMLPrinter printer;
    document_.Print(&printer);
    return printer.CStr();
  }

 private:
  struct Origin {
    Vector3 xyz;
    Matrix3 R;
  };

  Matrix3 of(const std::string& link) const {
    const auto found = R_.find(link);
    return found == R_.end() ? Matrix3(Matrix3::Identity()) : found->second;
  }
  static Vector3 vector(const tinyxml2::XMLElement& e, const char* attribute) {
    Vector3 v = Vector3::Zero();
    if (const char* text = e.Attribute(attribute)) {
      std::sscanf(text, "%lf %lf %lf", &v[0], &v[1], &v[2]);
    }
    return v;
  }
  static Vector3 xyz(tinyxml2::XMLElement& e) {
    const auto* origin = e.FirstChildElement("origin");
    return origin ? vector(*origin, "xyz") : Vector3(Vector3::Zero());
  }
  static Matrix3 rotation(tinyxml2::XMLElement& e) {
    const auto* origin = e.FirstChildElement("origin");
    const Vector3 rpy = origin ? vector(*origin, "rpy") : Vector3(Vector3::Zero());
    return rotationFromYawPitchRoll(rpy[2], rpy[1], rpy[0]);
  }
  static std::string three(const Vector3& v) {
    return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
  }
  void write(tinyxml2::XMLElement& e, const Origin& to) {
    auto* origin = e.FirstChildElement("origin");
    if (!origin) origin = e.InsertNewChildElement("origin");
    const Vector3 ypr = yawPitchRollFromRotation(to.R);
    origin->SetAttribute("xyz", three(to.xyz).c_str());
    origin->SetAttribute("rpy", three({ypr[2], ypr[1], ypr[0]}).c_str());
  }

  tinyxml2::XMLDocument document_;
  std::map<std::string, Matrix3> R_;
};

}  // namespace ballbot
