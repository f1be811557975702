#include "globe/scene/xml_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "globe/base/error.h"
#include "globe/base/one_line.h"
#include "globe/base/text_file.h"
#include "globe/scene/quantity.h"

namespace globe::scene {

XmlFile::XmlFile(const std::filesystem::path& file)
    : text_(read_text_file(file, kLongest)), name_(file.string()) {
  parse();
}

XmlFile::XmlFile(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {
  parse();
}

void XmlFile::parse() {
  lines_.push_back(0);
  for (std::size_t at = text_.find('\n'); at != std::string::npos; at = text_.find('\n', at + 1))
    lines_.push_back(static_cast<std::ptrdiff_t>(at) + 1);
  const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
  if (result) return;
  const auto line = std::upper_bound(lines_.begin(), lines_.end(), result.offset) - lines_.begin();
  throw Error(name_ + ":" + std::to_string(line), std::string("it is no XML: ") + result.description(),
              "mend the file");
}

int XmlFile::line(const pugi::xml_node& node) const {
  const auto line = std::upper_bound(lines_.begin(), lines_.end(), node.offset_debug()) - lines_.begin();
  return std::max(static_cast<int>(line), 1);
}

void XmlFile::refuse(const pugi::xml_node& node, const std::string& why,
                     const std::string& what_to_do) const {
  throw Error(name_ + ":" + std::to_string(line(node)), one_line(why), what_to_do);
}

std::optional<double> XmlFile::number(const pugi::xml_node& parent, std::string_view child) const {
  const pugi::xml_node node = child_named(parent, child);
  if (!node) return std::nullopt;
  const auto value = parse_plain(node.text().get());
  if (!value || !std::isfinite(*value))
    refuse(node,
           "<" + std::string(child) + "> holds \"" + one_line(node.text().get(), 40) + "\", not a number",
           "write a number");
  return value;
}

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_named(const pugi::xml_node& parent, std::string_view name) {
  return parent.find_child([&](const pugi::xml_node& node) { return local_name(node) == name; });
}

std::vector<pugi::xml_node> all_named(const pugi::xml_node& top, std::string_view name) {
  std::vector<pugi::xml_node> found;
  // Not by recursion: a file may be nested as deep as it is long.
  for (pugi::xml_node node = top; node;) {
    if (local_name(node) == name) found.push_back(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != top && !node.next_sibling()) node = node.parent();
    node = node == top ? pugi::xml_node() : node.next_sibling();
  }
  return found;
}

}  // namespace globe::scene
