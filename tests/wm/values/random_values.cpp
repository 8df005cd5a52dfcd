#include "castor/tests/wm/values/random_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace castor::test {

namespace {

constexpr int max_nesting = 3;

WireType random_type(const TypeDescriptor& descriptor, std::uint32_t owner, bool may_be_absent,
                     int nesting, Random& random) {
  auto kind = static_cast<WireKind>(between(random, 0, static_cast<int>(WireKind::enumeration)));
  switch (kind) {
    case WireKind::list:
    case WireKind::array:
    case WireKind::optional: {
      if (nesting == max_nesting)
        return {WireKind::int32, 0, 0, {}};
      auto extent = kind == WireKind::array ? between<std::uint32_t>(random, 1, 3) : 0u;
      return {kind,
              0,
              extent,
              {random_type(descriptor, owner, may_be_absent || kind != WireKind::array, nesting + 1,
                           random)}};
    }
    case WireKind::record: {
      // What must be there may only contain later records: else no value would ever end.
      auto first = may_be_absent ? 0 : owner + 1;
      auto count = static_cast<std::uint32_t>(descriptor.records.size());
      if (first >= count)
        return {WireKind::string, 0, 0, {}};
      return {kind, between(random, first, count - 1), 0, {}};
    }
    case WireKind::enumeration: {
      auto count = static_cast<std::uint32_t>(descriptor.enums.size());
      if (count == 0)
        return {WireKind::uint8, 0, 0, {}};
      return {kind, between<std::uint32_t>(random, 0, count - 1), 0, {}};
    }
    default:
      return {kind, 0, 0, {}};
  }
}

EnumDescriptor random_enum(std::size_t index, Random& random) {
  EnumDescriptor result;
  result.name = "E" + std::to_string(index);
  result.underlying = static_cast<WireKind>(
    between(random, static_cast<int>(WireKind::int8), static_cast<int>(WireKind::uint64)));
  bool is_signed = result.underlying <= WireKind::int64;
  for (int i = between(random, 0, 4); i > 0; --i)
    result.enumerators.emplace_back("e" + std::to_string(i),
                                    is_signed ? between<std::int64_t>(random, -128, 127)
                                              : between<std::int64_t>(random, 0, 255));
  return result;
}

class Writer {
public:
  Writer(const TypeDescriptor& descriptor, Random& random)
    : descriptor_(descriptor), random_(random) {}

  RandomValue write() {
    result_.json = Json::object();
    for (auto& field : descriptor_.records.front().fields) {
      result_.json[field.name] = value(field.type, field.name);
      result_.ends.push_back(result_.bytes.size());
    }
    return std::move(result_);
  }

private:
  using Json = nlohmann::ordered_json;

  /// Inside lists and arrays there are no paths: `path` is empty there.
  Json value(const WireType& type, const std::string& path) {
    switch (type.kind) {
      case WireKind::boolean: {
        auto x = between(random_, 0, 1);
        put(static_cast<std::uint8_t>(x));
        return found(path, x == 1);
      }
      case WireKind::float32:
        return found(path, static_cast<double>(put(real<float>())));
      case WireKind::float64:
        return found(path, put(real<double>()));
      case WireKind::string:
        return found(path, text());
      case WireKind::bytes: {
        // Three bytes make four digits, and these make digits that are easy to foretell.
        auto n = between<std::uint32_t>(random_, 0, 3) * 3;
        put(n);
        for (std::uint32_t i = 0; i < n; ++i)
          put(std::uint8_t{0});
        return std::string(n / 3 * 4, 'A');
      }
      case WireKind::list: {
        auto length = begin_length();
        auto n = --budget_ > 0 ? between<std::uint32_t>(random_, 0, 3) : 0u;
        put(n);
        auto json = elements(type.element.front(), n);
        end_length(length);
        return json;
      }
      case WireKind::array:
        return elements(type.element.front(), type.extent);
      case WireKind::optional:
        if (--budget_ > 0 && between(random_, 0, 2) > 0) {
          put(std::uint8_t{1});
          return value(type.element.front(), path);
        }
        put(std::uint8_t{0});
        absent(type.element.front(), path, 0);
        return nullptr;
      case WireKind::record: {
        auto length = begin_length();
        auto json = Json::object();
        for (auto& field : descriptor_.records[type.index].fields)
          json[field.name] = value(field.type, path.empty() ? path : path + '.' + field.name);
        end_length(length);
        return json;
      }
      case WireKind::enumeration:
        return enumerator(descriptor_.enums[type.index], path);
      default:
        return integer(type.kind, path);
    }
  }

  Json elements(const WireType& type, std::uint32_t n) {
    auto json = Json::array();
    for (std::uint32_t i = 0; i < n; ++i)
      json.push_back(value(type, ""));
    return json;
  }

  /// Records that the single values below an absent optional are absent too.
  void absent(const WireType& type, const std::string& path, int depth) {
    if (path.empty() || depth > max_nesting)
      return;
    if (type.kind == WireKind::optional)
      return absent(type.element.front(), path, depth);
    if (type.kind == WireKind::record) {
      for (auto& field : descriptor_.records[type.index].fields)
        absent(field.type, path + '.' + field.name, depth + 1);
    } else if (type.kind != WireKind::list && type.kind != WireKind::array &&
               type.kind != WireKind::bytes) {
      result_.fields[path] = std::monostate{};
    }
  }

  Json enumerator(const EnumDescriptor& e, const std::string& path) {
    // Mostly one of those that have a name; what is no number of the underlying type is cut off.
    std::int64_t number = between<std::int64_t>(random_, 0, 127);
    if (!e.enumerators.empty() && between(random_, 0, 3) > 0)
      number = e.enumerators[between<std::size_t>(random_, 0, e.enumerators.size() - 1)].second;
    put_integer(e.underlying, static_cast<std::uint64_t>(number));
    auto named = std::find_if(e.enumerators.begin(), e.enumerators.end(),
                              [&](auto& x) { return x.second == number; });
    return found(path, named == e.enumerators.end() ? std::to_string(number) : named->first);
  }

  Json integer(WireKind kind, const std::string& path) {
    auto bits = std::array<std::uint64_t, 4>{0, 1, ~std::uint64_t{0},
                                             random_()}[between<std::size_t>(random_, 0, 3)];
    put_integer(kind, bits);
    switch (kind) {
      case WireKind::int8:
        return found(path, std::int64_t{static_cast<std::int8_t>(bits)});
      case WireKind::int16:
        return found(path, std::int64_t{static_cast<std::int16_t>(bits)});
      case WireKind::int32:
        return found(path, std::int64_t{static_cast<std::int32_t>(bits)});
      case WireKind::int64:
        return found(path, static_cast<std::int64_t>(bits));
      case WireKind::uint8:
        return found(path, std::uint64_t{static_cast<std::uint8_t>(bits)});
      case WireKind::uint16:
        return found(path, std::uint64_t{static_cast<std::uint16_t>(bits)});
      case WireKind::uint32:
        return found(path, std::uint64_t{static_cast<std::uint32_t>(bits)});
      default:
        return found(path, bits);
    }
  }

  template <class T>
  T real() {
    switch (between(random_, 0, 5)) {
      case 0:
        return 0;
      case 1:
        return std::numeric_limits<T>::infinity();
      case 2:
        return std::numeric_limits<T>::max();
      case 3:
        return std::numeric_limits<T>::denorm_min();
      default:
        return std::uniform_real_distribution<T>{-1000, 1000}(random_);
    }
  }

  std::string text() {
    static const std::vector<std::string> parts{"a", "B", " ", "\"", "\\", "\n", "\xc3\xa9", "1"};
    std::string result;
    for (int i = between(random_, 0, 5); i > 0; --i)
      result += parts[between<std::size_t>(random_, 0, parts.size() - 1)];
    put(static_cast<std::uint32_t>(result.size()));
    result_.bytes.insert(result_.bytes.end(), result.begin(), result.end());
    return result;
  }

  template <class T>
  Json found(const std::string& path, T x) {
    if (!path.empty())
      result_.fields[path] = x;
    if constexpr (std::is_same_v<T, double>)
      return std::isfinite(x) ? Json(x) : Json(nullptr);
    return x;
  }

  template <class T>
  T put(T x) {
    auto at = result_.bytes.size();
    result_.bytes.resize(at + sizeof(T));
    std::memcpy(result_.bytes.data() + at, &x, sizeof(T));
    return x;
  }

  void put_integer(WireKind kind, std::uint64_t bits) {
    auto base = kind >= WireKind::uint8 ? WireKind::uint8 : WireKind::int8;
    auto size = std::size_t{1} << (static_cast<int>(kind) - static_cast<int>(base));
    for (std::size_t i = 0; i < size; ++i)
      put(static_cast<std::uint8_t>(bits >> (8 * i)));
  }

  std::size_t begin_length() {
    put(std::uint32_t{0});
    return result_.bytes.size();
  }

  void end_length(std::size_t begin) {
    auto n = static_cast<std::uint32_t>(result_.bytes.size() - begin);
    std::memcpy(result_.bytes.data() + begin - sizeof(n), &n, sizeof(n));
  }

  const TypeDescriptor& descriptor_;
  Random& random_;
  RandomValue result_;
  /// How many lists and optionals may still hold something.
  int budget_ = 40;
};

} // namespace

TypeDescriptor random_descriptor(Random& random) {
  TypeDescriptor result;
  auto records = between<std::size_t>(random, 1, 3);
  for (std::size_t i = 0; i < records; ++i)
    result.records.push_back({"R" + std::to_string(i), {}});
  for (std::size_t i = between<std::size_t>(random, 0, 2); i > 0; --i)
    result.enums.push_back(random_enum(i, random));
  for (std::uint32_t i = 0; i < records; ++i)
    for (int j = between(random, 0, 5); j > 0; --j)
      result.records[i].fields.push_back(
        {std::string(1, static_cast<char>('a' + j)), random_type(result, i, false, 0, random)});
  for (int i = between(random, 0, 2); i > 0; --i)
    result.super_types.push_back("S" + std::to_string(i));
  return result;
}

RandomValue random_value(const TypeDescriptor& descriptor, Random& random) {
  return Writer{descriptor, random}.write();
}

void damage(Bytes& bytes, Random& random) {
  for (int i = between(random, 1, 3); i > 0; --i) {
    auto at = between<std::size_t>(random, 0, bytes.size());
    auto left = bytes.size() - at;
    auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    auto some =
      static_cast<std::ptrdiff_t>(between<std::size_t>(random, 0, std::min<std::size_t>(left, 8)));
    switch (between(random, 0, 5)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(place, place + some);
        break;
      case 2:
        bytes.insert(place, static_cast<std::size_t>(some), static_cast<std::uint8_t>(random()));
        break;
      case 3:
        if (left > 0)
          *place = static_cast<std::uint8_t>(random());
        break;
      case 4:
        if (left > 0)
          *place = static_cast<std::uint8_t>(*place + (random() % 2 == 0 ? 1 : -1));
        break;
      default: {
        // A length or count just below 4 GiB, 2 GiB or 16 MiB.
        auto huge = static_cast<std::uint32_t>(std::array<std::uint32_t, 3>{
          0xffffffff, 0x7fffffff, 0xffffff}[between<std::size_t>(random, 0, 2)]);
        if (left >= sizeof(huge))
          std::memcpy(bytes.data() + at, &huge, sizeof(huge));
      }
    }
  }
}

Bytes random_bytes(std::size_t max_size, Random& random) {
  // Mostly small numbers: as lengths, counts and kinds they lead further in than large ones.
  Bytes result(between<std::size_t>(random, 0, max_size));
  for (auto& x : result)
    x =
      static_cast<std::uint8_t>(random() % 4 == 0 ? random() : random() % 12 * (random() % 3 == 0));
  return result;
}

} // namespace castor::test
