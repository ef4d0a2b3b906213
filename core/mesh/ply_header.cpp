#include "mesh/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <unordered_set>
#include <utility>

#include "base/error.h"
#include "mesh/ply_input.h"

namespace shbake {
namespace {

constexpr std::size_t kLongestHeaderLine = 1 << 20;
constexpr std::string_view kBlanks = " \t\v\f\r\n";

struct TypeNames {
  const char* written;
  const char* sized;
};
// In the order of ScalarType.
constexpr TypeNames kTypeNames[] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
                                    {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
// In the order of PlyEncoding.
constexpr const char* kEncodingNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != line.npos; at = line.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/// A byte string fit for a message: at most 40 bytes, with '?' for what cannot be printed.
std::string quoted(std::string_view text) {
  std::string shown(text.substr(0, 40));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  }
  return "'" + shown + (text.size() > 40 ? "…'" : "'");
}

/// Reads the header line by line into `header`.
class HeaderParser {
 public:
  explicit HeaderParser(PlyInput& input) : input_(input) {}

  PlyHeader parse() {
    readMagic();
    std::string_view line;
    while (input_.getLine(line, header_.lineEnd, kLongestHeaderLine)) {
      const auto words = wordsOf(line);
      if (words.empty()) continue;
      if (words[0] == "end_header") return finish();
      readLine(line, words);
    }
    throw Error({.file = input_.path(),
                 .place = "header line " + std::to_string(input_.lineNumber()),
                 .cause = "the file ends before end_header",
                 .remedy = "get the whole file: it was cut short"});
  }

 private:
  [[noreturn]] void fail(std::string cause, std::string remedy) const {
    throw Error({.file = input_.path(),
                 .place = "header line " + std::to_string(input_.lineNumber()),
                 .cause = std::move(cause),
                 .remedy = std::move(remedy)});
  }

  /// The first line decides how lines end.
  void readMagic() {
    const std::string_view view = input_.peek(80);
    if (view.empty()) throw Error({.file = input_.path(), .cause = "is empty", .remedy = "choose a PLY file"});
    const std::size_t end = view.find_first_of("\r\n");
    if (end != view.npos && view[end] == '\r' && (end + 1 == view.size() || view[end + 1] != '\n')) {
      header_.lineEnd = '\r';
    }
    const auto words = wordsOf(view.substr(0, end));
    if (words.size() != 1 || words[0] != "ply" || view[0] != 'p') {
      throw Error({.file = input_.path(),
                   .cause = "is not a PLY file: its first line is not 'ply'",
                   .remedy = "choose a PLY file, or name the file by what it is"});
    }
    std::string_view line;
    input_.getLine(line, header_.lineEnd, kLongestHeaderLine);
  }

  void readLine(std::string_view line, const std::vector<std::string_view>& words) {
    if (words[0] == "comment") {
      // One blank separates the word from the text; further ones belong to the text.
      const std::string_view text = line.substr(line.find("comment") + 7);
      header_.comments.emplace_back(text.substr(std::min<std::size_t>(1, text.size())));
    } else if (words[0] == "obj_info") {
      header_.comments.emplace_back(line.substr(line.find("obj_info")));
    } else if (words[0] == "format") {
      readFormat(words);
    } else if (words[0] == "element") {
      readElement(words);
    } else if (words[0] == "property") {
      readProperty(words);
    } else {
      fail("the word " + quoted(words[0]) + " is not known",
           "expected format, comment, obj_info, element, property or end_header");
    }
  }

  void readFormat(const std::vector<std::string_view>& words) {
    if (encoding_) fail("a second format line", "keep one");
    const auto* name = words.size() == 3 ? std::ranges::find(kEncodingNames, words[1]) : std::end(kEncodingNames);
    if (name == std::end(kEncodingNames) || words[2] != "1.0") {
      fail("the format is not known",
           "expected 'format', one of ascii, binary_little_endian or binary_big_endian, and 1.0");
    }
    encoding_ = static_cast<PlyEncoding>(name - kEncodingNames);
  }

  void readElement(const std::vector<std::string_view>& words) {
    PlyElement element;
    if (words.size() == 3) {
      const char* end = words[2].data() + words[2].size();
      const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
      if (error == std::errc{} && stop == end) {
        element.name = words[1];
        if (!elementNames_.insert(element.name).second) {
          fail("element " + quoted(words[1]) + " is declared twice", "keep one");
        }
        propertyNames_.clear();
        header_.elements.push_back(std::move(element));
        return;
      }
    }
    fail("an element is declared wrongly", "expected 'element', a name and a count of 0 or more");
  }

  ScalarType typeOf(std::string_view name) const {
    const auto* found =
        std::ranges::find_if(kTypeNames, [&](const TypeNames& t) { return name == t.written || name == t.sized; });
    if (found == std::end(kTypeNames)) {
      fail("the type " + quoted(name) + " is not known",
           "expected char, uchar, short, ushort, int, uint, float or double, or int8 to float64");
    }
    return static_cast<ScalarType>(found - kTypeNames);
  }

  void readProperty(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) fail("a property stands before the first element", "declare its element first");
    PlyElement& element = header_.elements.back();
    PlyProperty property;
    property.isList = words.size() > 1 && words[1] == "list";
    if (words.size() != (property.isList ? 5u : 3u)) {
      fail("a property is declared wrongly",
           "expected 'property', a type and a name, or 'property list', two types and a name");
    }
    property.name = words.back();
    property.type = typeOf(words[words.size() - 2]);
    if (property.isList) {
      property.countType = typeOf(words[2]);
      if (isFloatType(property.countType)) {
        fail("the length of list " + quoted(property.name) + " is not of an integer type",
             "declare it as uchar or int");
      }
    }
    if (!propertyNames_.insert(property.name).second) {
      fail("property " + quoted(property.name) + " of element " + quoted(element.name) + " is declared twice",
           "rename one of them");
    }
    element.properties.push_back(std::move(property));
  }

  PlyHeader finish() {
    if (!encoding_) fail("there is no format line", "add one, such as 'format ascii 1.0', behind the first line");
    header_.encoding = *encoding_;
    return std::move(header_);
  }

  PlyInput& input_;
  PlyHeader header_;
  std::optional<PlyEncoding> encoding_;
  std::unordered_set<std::string> elementNames_, propertyNames_;  // the latter of the last element
};

/// Adds a name to those that are taken.
void claimName(std::unordered_set<std::string>& names, const std::string& name, const char* what) {
  if (name.empty() || name.find_first_of(kBlanks) != name.npos) {
    throw usageError(std::string(what) + " " + quoted(name) + " cannot be written to a PLY file",
                     "use a name without blanks");
  }
  if (!names.insert(name).second) {
    throw usageError(std::string(what) + " " + quoted(name) + " would stand twice in a PLY file", "rename one of them");
  }
}

/// Appends comment lines, one for every line of `comment`.
void appendComment(std::string& text, std::string_view comment) {
  const bool info = comment == "obj_info" || comment.starts_with("obj_info ");
  for (std::size_t at = 0; at <= comment.size();) {
    const std::size_t end = std::min(comment.find_first_of("\r\n", at), comment.size());
    const std::string_view line = comment.substr(at, end - at);
    if (!info || at > 0) text += line.empty() ? "comment" : "comment ";
    text.append(line).push_back('\n');
    at = end + (comment.substr(end).starts_with("\r\n") ? 2 : 1);
  }
}

}  // namespace

const PlyProperty* PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  return found == properties.end() ? nullptr : &*found;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

const char* encodingName(PlyEncoding encoding) {
  return kEncodingNames[static_cast<std::size_t>(encoding)];
}

const char* scalarName(ScalarType type) {
  return kTypeNames[static_cast<std::size_t>(type)].written;
}

PlyHeader readPlyHeader(const std::string& path) {
  PlyInput input(path);
  return readPlyHeader(input);
}

PlyHeader readPlyHeader(PlyInput& input) {
  return HeaderParser(input).parse();
}

std::string plyHeaderText(const PlyHeader& header) {
  std::string text = std::string("ply\nformat ") + encodingName(header.encoding) + " 1.0\n";
  for (const std::string& comment : header.comments) appendComment(text, comment);
  std::unordered_set<std::string> elementNames;
  for (const PlyElement& element : header.elements) {
    claimName(elementNames, element.name, "the element name");
    text += "element " + element.name + " " + std::to_string(element.count) + "\n";
    std::unordered_set<std::string> propertyNames;
    for (const PlyProperty& property : element.properties) {
      claimName(propertyNames, property.name, "the property name");
      text += "property ";
      if (property.isList) text += std::string("list ") + scalarName(property.countType) + " ";
      text += scalarName(property.type);
      text += " " + property.name + "\n";
    }
  }
  return text + "end_header\n";
}

}  // namespace shbake
