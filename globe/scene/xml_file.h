#pragma once

#include <filesystem>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace globe::scene {

/// An XML file, with the lines of its elements.
///
/// By pugixml without document types: entities other than XML's own five stay as they are written, so that
/// none grows. Files of more than kLongest bytes are refused.
class XmlFile {
 public:
  static constexpr std::size_t kLongest = std::size_t{64} << 20;

  /// Throws Error, naming file and line, when it is no XML.
  explicit XmlFile(const std::filesystem::path& file);
  XmlFile(std::string text, std::string name);

  pugi::xml_node root() const { return document_.document_element(); }
  int line(const pugi::xml_node& node) const;
  const std::string& name() const { return name_; }

  /// Throws Error about an element.
  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& why,
                           const std::string& what_to_do) const;

  /// The number that a child element holds; nothing when there is no such child. Throws Error when it is
  /// none.
  std::optional<double> number(const pugi::xml_node& parent, std::string_view child) const;

 private:
  void parse();

  std::string text_;
  std::string name_;
  pugi::xml_document document_;
  std::vector<std::ptrdiff_t> lines_;  ///< where each begins
};

/// The name of an element or attribute without its prefix: "Tour" of "gx:Tour".
std::string_view local_name(const pugi::xml_node& node);

/// The first child element of such a local name; an empty node when there is none.
pugi::xml_node child_named(const pugi::xml_node& parent, std::string_view name);

/// All elements below a node, itself included, of such a local name, in the file's order, however deep.
std::vector<pugi::xml_node> all_named(const pugi::xml_node& top, std::string_view name);

}  // namespace globe::scene
