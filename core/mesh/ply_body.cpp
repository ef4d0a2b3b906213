#include "mesh/ply_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

// Rows are decoded and progress is told in blocks of this many bytes: some milliseconds of work.
constexpr std::size_t kBlockBytes = 1 << 20;

template <class T>
T byteSwapped(T value) {
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

template <class T>
T load(const char* from, bool swap) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return swap ? byteSwapped(value) : value;
}

std::int64_t loadInteger(ScalarType type, const char* from, bool swap) {
  return withScalarType(type,
                        [&]<class T>(std::type_identity<T>) { return static_cast<std::int64_t>(load<T>(from, swap)); });
}

template <class Bits>
void gatherBits(const char* from, std::size_t stride, std::size_t count, bool swap, std::byte* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const Bits bits = load<Bits>(from + i * stride, swap);
    std::memcpy(to + i * sizeof(Bits), &bits, sizeof(Bits));
  }
}

/// Copies `count` scalars of `size` bytes that lie `stride` bytes apart to a packed array, in the machine's byte order.
void gather(std::size_t size, const char* from, std::size_t stride, std::size_t count, bool swap, std::byte* to) {
  switch (size) {
    case 1:
      return gatherBits<std::uint8_t>(from, stride, count, swap, to);
    case 2:
      return gatherBits<std::uint16_t>(from, stride, count, swap, to);
    case 4:
      return gatherBits<std::uint32_t>(from, stride, count, swap, to);
    default:
      return gatherBits<std::uint64_t>(from, stride, count, swap, to);
  }
}

/// Reads a number at the front of `text` as the type T; moves `at` behind it.
/// Values beyond the range of a floating type become infinite or zero, as its arithmetic would make them.
template <class T>
std::errc parseNumber(const char*& at, const char* end, T& value) {
  if (at != end && *at == '+' && at + 1 != end && at[1] != '-') ++at;
  auto result = std::from_chars(at, end, value);
  if constexpr (std::is_floating_point_v<T>) {
    if (result.ec == std::errc::result_out_of_range) {
      long double wide = 0;
      result = std::from_chars(at, end, wide);
      value = static_cast<T>(wide);
    }
  }
  at = result.ptr;
  return result.ec;
}

bool isBlank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

struct Column {
  Property property;
  std::size_t size = 0;  // bytes of a scalar
  bool toSink = false;
};

/// Decodes one element.
class ElementReader {
 public:
  ElementReader(PlyInput& input, const PlyHeader& header, Progress& progress, const PlyElement& element,
                std::string_view sinkList, const PlyListSink& sink)
      : input_(input),
        progress_(progress),
        element_(element),
        sink_(sink),
        lineEnd_(header.lineEnd),
        ascii_(header.encoding == PlyEncoding::ascii),
        swap_((header.encoding == PlyEncoding::binaryBigEndian) != (std::endian::native == std::endian::big)) {
    for (const PlyProperty& p : element.properties) {
      columns_.push_back({{p.name, p.type, p.isList, p.countType, {}, {}}, scalarSize(p.type), p.name == sinkList});
      hasLists_ = hasLists_ || p.isList;
      leastRowBytes_ += ascii_ ? 2 : p.isList ? scalarSize(p.countType) : columns_.back().size;
    }
  }

  std::vector<Property> read() {
    if (!columns_.empty()) {
      allocate();
      ascii_ ? readAscii() : hasLists_ ? readRows() : readFixedRows();
    }
    std::vector<Property> properties;
    for (Column& c : columns_) {
      if (!c.toSink) properties.push_back(std::move(c.property));
    }
    return properties;
  }

 private:
  [[noreturn]] void fail(std::uint64_t item, std::string cause, std::string remedy) const {
    std::string place = plyItemName(element_, item);
    if (ascii_) place += " (line " + std::to_string(input_.lineNumber()) + ")";
    throw Error({.file = input_.path(), .place = place, .cause = std::move(cause), .remedy = std::move(remedy)});
  }

  [[noreturn]] void failTruncated(std::uint64_t item) const {
    fail(item,
         "the file ends here, but its header declares " + std::to_string(element_.count) + " of element " +
             element_.name,
         "get the whole file: it was cut short, or its header is wrong");
  }

  /// Room for as many rows as the header declares and the file can hold, the last perhaps cut short.
  void allocate() {
    const std::uint64_t bytes = input_.remaining() + (ascii_ ? 1 : 0);  // the last line may lack its end
    const std::uint64_t fitting = bytes / leastRowBytes_;
    if (!ascii_ && element_.count > fitting && !hasLists_) failTruncated(fitting);
    const auto rows = static_cast<std::size_t>(std::min(element_.count, fitting + 1));
    for (Column& c : columns_) {
      if (c.toSink) continue;
      if (c.property.isList) {
        c.property.listStarts.reserve(rows + 1);
        c.property.listStarts.push_back(0);
      } else {
        c.property.values.resize(rows * c.size);
      }
    }
  }

  /// Binary rows of equal size: whole columns of a block at once.
  void readFixedRows() {
    const std::size_t blockRows = std::max<std::size_t>(1, kBlockBytes / leastRowBytes_);
    for (std::uint64_t item = 0; item < element_.count;) {
      const auto rows = static_cast<std::size_t>(std::min<std::uint64_t>(blockRows, element_.count - item));
      const std::string_view block = input_.peek(rows * leastRowBytes_);
      if (block.size() < rows * leastRowBytes_) failTruncated(item + block.size() / leastRowBytes_);
      const char* from = block.data();
      for (Column& c : columns_) {
        gather(c.size, from, leastRowBytes_, rows, swap_, c.property.values.data() + item * c.size);
        from += c.size;
      }
      advance(rows * leastRowBytes_);
      item += rows;
    }
  }

  /// Binary rows with lists: one row after the other, as many as the window holds.
  void readRows() {
    std::size_t wanted = kBlockBytes;
    for (std::uint64_t item = 0; item < element_.count;) {
      const std::string_view block = input_.peek(wanted);
      std::size_t at = 0;
      for (; item < element_.count; ++item) {
        const auto bytes = rowBytes(block.substr(at), item);
        if (!bytes) break;
        decodeRow(block.data() + at, item);
        at += *bytes;
      }
      if (at == 0 && block.size() == input_.remaining()) failTruncated(item);
      wanted = at == 0 ? 2 * block.size() : kBlockBytes;
      advance(at);
    }
  }

  /// The size of the row at the front of `block`; nothing when it ends behind it.
  std::optional<std::size_t> rowBytes(std::string_view block, std::uint64_t item) const {
    std::size_t at = 0;
    for (const Column& c : columns_) {
      if (!c.property.isList) {
        at += c.size;
        continue;
      }
      const std::size_t countSize = scalarSize(c.property.countType);
      if (at + countSize > block.size()) return {};
      const std::int64_t count = loadInteger(c.property.countType, block.data() + at, swap_);
      requireLength(c, count, item);
      const std::uint64_t bytes = static_cast<std::uint64_t>(count) * c.size;
      if (bytes > input_.remaining()) failTruncated(item);
      at += countSize + static_cast<std::size_t>(bytes);
    }
    return at <= block.size() ? std::optional(at) : std::nullopt;
  }

  void requireLength(const Column& c, std::int64_t count, std::uint64_t item) const {
    if (count >= 0) return;
    fail(item, "list " + c.property.name + " has the negative length " + std::to_string(count),
         "check that the header declares the right types");
  }

  void decodeRow(const char* from, std::uint64_t item) {
    for (Column& c : columns_) {
      Property& p = c.property;
      std::size_t count = 1;
      std::byte* to = p.values.data() + item * c.size;
      if (p.isList) {
        count = static_cast<std::size_t>(loadInteger(p.countType, from, swap_));
        from += scalarSize(p.countType);
        if (c.toSink) {
          sendList(p.type, from, count, item);
          from += count * c.size;
          continue;
        }
        to = growList(p, count);
      }
      gather(c.size, from, c.size, count, swap_, to);
      from += count * c.size;
    }
  }

  void sendList(ScalarType type, const char* from, std::size_t count, std::uint64_t item) {
    list_.resize(count);
    withScalarType(type, [&]<class T>(std::type_identity<T>) {
      for (std::size_t i = 0; i < count; ++i) {
        list_[i] = static_cast<std::int64_t>(load<T>(from + i * sizeof(T), swap_));
      }
    });
    sink_(item, list_);
  }

  /// Appends a list of `count` scalars to a column; returns where they go.
  std::byte* growList(Property& p, std::size_t count) {
    const std::size_t old = p.values.size();
    p.values.resize(old + count * scalarSize(p.type));
    p.listStarts.push_back(p.listStarts.back() + count);
    return p.values.data() + old;
  }

  void readAscii() {
    std::size_t blockBytes = 0;
    for (std::uint64_t item = 0; item < element_.count; ++item) {
      const std::string_view line = nextRow(item);
      const char* at = line.data();
      const char* const end = at + line.size();
      for (Column& c : columns_) decodeText(c, at, end, item);
      while (at != end && isBlank(*at)) ++at;
      if (at != end) {
        fail(item, "there are more values on the line than the header declares", "check the header against the rows");
      }
      blockBytes += line.size() + 1;
      if (blockBytes >= kBlockBytes) progress_.advance(static_cast<double>(std::exchange(blockBytes, 0)));
    }
    progress_.advance(static_cast<double>(blockBytes));
  }

  /// The next line that is not blank.
  std::string_view nextRow(std::uint64_t item) {
    std::string_view line;
    do {
      if (!input_.getLine(line, lineEnd_, std::numeric_limits<std::size_t>::max())) failTruncated(item);
    } while (std::ranges::all_of(line, isBlank));
    return line;
  }

  void decodeText(Column& c, const char*& at, const char* end, std::uint64_t item) {
    Property& p = c.property;
    if (!p.isList) {
      withScalarType(p.type, [&]<class T>(std::type_identity<T>) {
        const T value = parse<T>(p, at, end, item);
        std::memcpy(p.values.data() + item * sizeof(T), &value, sizeof(T));
      });
      return;
    }
    const std::int64_t count = withScalarType(p.countType, [&]<class T>(std::type_identity<T>) {
      return static_cast<std::int64_t>(parse<T>(p, at, end, item));
    });
    requireLength(c, count, item);
    list_.clear();
    withScalarType(p.type, [&]<class T>(std::type_identity<T>) {
      for (std::int64_t i = 0; i < count; ++i) {
        const T value = parse<T>(p, at, end, item);
        if (c.toSink) {
          list_.push_back(static_cast<std::int64_t>(value));
        } else {
          const auto* bytes = reinterpret_cast<const std::byte*>(&value);
          p.values.insert(p.values.end(), bytes, bytes + sizeof(T));
        }
      }
    });
    if (c.toSink) {
      sink_(item, list_);
    } else {
      p.listStarts.push_back(p.listStarts.back() + static_cast<std::uint64_t>(count));
    }
  }

  /// The next value of a line, for property `p`.
  template <class T>
  T parse(const Property& p, const char*& at, const char* end, std::uint64_t item) const {
    while (at != end && isBlank(*at)) ++at;
    if (at == end) {
      fail(item, "the line ends before property " + p.name + " is complete", "check the header against the rows");
    }
    const char* const begin = at;
    T value{};
    const std::errc error = parseNumber(at, end, value);
    if (error != std::errc{} || (at != end && !isBlank(*at))) failNumber<T>(p, begin, end, item, error);
    return value;
  }

  template <class T>
  [[noreturn]] void failNumber(const Property& p, const char* begin, const char* end, std::uint64_t item,
                               std::errc error) const {
    constexpr std::ptrdiff_t kShown = 30;
    const std::string token(begin, std::find_if(begin, std::min(end, begin + std::min(kShown, end - begin)), isBlank));
    const bool negative = std::is_unsigned_v<T> && *begin == '-';
    const bool range = negative || error == std::errc::result_out_of_range;
    const char* why = range                         ? "does not fit the type of property "
                      : std::is_floating_point_v<T> ? "is not a number, as property "
                                                    : "is not an integer, as property ";
    fail(item, "'" + token + "' " + why + p.name + (range ? "" : " asks for"),
         "correct the value, or the type in the header");
  }

  void advance(std::size_t bytes) {
    input_.skip(bytes);
    progress_.advance(static_cast<double>(bytes));
  }

  PlyInput& input_;
  Progress& progress_;
  const PlyElement& element_;
  const PlyListSink& sink_;
  char lineEnd_;
  bool ascii_, swap_, hasLists_ = false;
  std::size_t leastRowBytes_ = 0;
  std::vector<Column> columns_;
  std::vector<std::int64_t> list_;  // reused from row to row
};

}  // namespace

std::string plyItemName(const PlyElement& element, std::uint64_t item) {
  return element.name + " " + std::to_string(item);
}

std::vector<Property> PlyBody::readElement(const PlyElement& element, std::string_view sinkList,
                                           const PlyListSink& sink) {
  return ElementReader(input_, header_, progress_, element, sinkList, sink).read();
}

}  // namespace shbake
