#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/state.hpp"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace ballbot {

/// One element of a URDF's XML, read strictly: what is asked for is there, once, and well written.
/// Every error is an InputError "<file>:<line>: <element> of link 'arm_2': ...". It must not
/// outlive its UrdfXml.
class UrdfElement {
 public:
  UrdfElement(const tinyxml2::XMLElement* element, const std::string* file)
      : element_(element), file_(file) {}

  std::string tag() const;
  int line() const;

  /// The one child of this tag, if there is one. @throw InputError if there are several.
  std::optional<UrdfElement> child(const char* tag) const;
  UrdfElement requiredChild(const char* tag) const;
  std::vector<UrdfElement> children() const;

  /// A text that is not empty.
  std::string text(const char* attribute) const;
  /// A finite number in the way of XML and C: decimal point, any white space around it.
  double number(const char* attribute) const;
  std::optional<double> numberIfAny(const char* attribute) const;
  /// As numberIfAny, but "inf" is a number too.
  std::optional<double> limitIfAny(const char* attribute) const;
  /// Three finite numbers with any white space between them.
  Vector3 vectorOr(const char* attribute, const Vector3& fallback) const;

  /// @throw InputError naming the first attribute that is not one of `known`, and its nearest.
  void onlyAttributes(std::initializer_list<const char*> known) const;
  /// Strange children are allowed, for everyone hangs things into a URDF, but not those whose tag
  /// is nearly one of `known`, nor what only xacro understands. @throw InputError
  void noMisspeltChildren(std::initializer_list<const char*> known) const;

  /// @throw InputError "<file>:<line>: <tag> of link 'x': <what>".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::vector<double> numbers(const char* attribute, std::size_t count) const;
  [[noreturn]] void failNumber(const char* attribute, std::size_t count) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

/// The XML of a URDF.
class UrdfXml {
 public:
  /// @param file  where `text` stands, for messages
  /// @throw InputError with the line if `text` is no XML or its root is not <robot>.
  UrdfXml(std::string file, const std::string& text);
  ~UrdfXml();
  UrdfXml(const UrdfXml&) = delete;
  UrdfXml& operator=(const UrdfXml&) = delete;

  UrdfElement robot() const;

 private:
  std::string file_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

}  // namespace ballbot
