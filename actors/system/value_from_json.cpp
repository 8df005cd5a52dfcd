#include "castor/actors/system/value_from_json.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/wm/values/base64.hpp"
#include "castor/wm/values/encoding.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

namespace castor {

namespace {

using Json = nlohmann::ordered_json;

/// Of records and lists inside of one another.
constexpr int deepest = 100;

std::string kind_of(const Json& x) {
  switch (x.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::boolean:
      return x.get<bool>() ? "true" : "false";
    case Json::value_t::string:
      return "a text";
    case Json::value_t::array:
      return "a list of " + std::to_string(x.size());
    case Json::value_t::object:
      return "an object";
    default:
      return x.dump();
  }
}

std::string joined(const std::vector<std::string_view>& names) {
  std::string result;
  for (auto name : names)
    result.append(result.empty() ? "" : ", ").append(name);
  return result;
}

/// "; did you mean 'x'?", or what there is.
std::string remedy(std::string_view name, const std::vector<std::string_view>& known,
                   const std::string& otherwise) {
  auto guess = did_you_mean(name, known);
  return "; " + (guess.empty() ? otherwise + joined(known) : guess);
}

class Writer {
public:
  explicit Writer(const TypeDescriptor& descriptor) : descriptor_(descriptor) {}

  /// The fields of a record, without its length. `base` has the fields of another value of the
  /// record; null if there is none.
  Bytes record(const RecordDescriptor& record, const Json& json, Decoder* base,
               const std::string& path) {
    if (!json.is_object())
      fail(path, "has to be an object with the fields of " + record.name + ", but it is " +
                   kind_of(json));
    check_names(record, json, path);
    Bytes result;
    std::vector<std::string_view> missing;
    for (auto& field : record.fields) {
      auto given = json.find(field.name);
      auto before = base ? take(*base, field.type) : std::span<const std::uint8_t>{};
      if (given != json.end())
        append(result, value(field.type, *given, base ? &before : nullptr,
                             path.empty() ? field.name : path + '.' + field.name));
      else if (base)
        append(result, before);
      else if (field.type.kind == WireKind::optional)
        result.push_back(0);
      else
        missing.push_back(field.name);
    }
    if (!missing.empty())
      fail(path, (missing.size() == 1 ? "lacks the field " : "lacks the fields ") +
                   joined(missing) + " of " + record.name);
    return result;
  }

private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw ValueError((path.empty() ? "the value" : path) + ' ' + what);
  }

  void check_names(const RecordDescriptor& record, const Json& json,
                   const std::string& path) const {
    std::vector<std::string_view> known;
    for (auto& field : record.fields)
      known.push_back(field.name);
    for (auto& [name, x] : json.items())
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw ValueError(record.name + " has no field " + (path.empty() ? "" : path + '.') + name +
                         remedy(name, known, "it has "));
  }

  /// The next field of `in`, as it stands there.
  std::span<const std::uint8_t> take(Decoder& in, const WireType& type) const {
    auto before = in;
    in.skip(descriptor_, type);
    return before.take(before.remaining() - in.remaining());
  }

  static void append(Bytes& to, std::span<const std::uint8_t> x) {
    to.insert(to.end(), x.begin(), x.end());
  }

  template <class T>
  static Bytes bytes_of(const T& x) {
    Bytes result(sizeof(T));
    std::memcpy(result.data(), &x, sizeof(T));
    return result;
  }

  static Bytes with_length(const Bytes& x) {
    auto length = static_cast<std::uint32_t>(x.size());
    Bytes result(sizeof(length) + x.size());
    std::memcpy(result.data(), &length, sizeof(length));
    std::copy(x.begin(), x.end(), result.begin() + sizeof(length));
    return result;
  }

  Bytes value(const WireType& type, const Json& json, const std::span<const std::uint8_t>* base,
              const std::string& path) {
    switch (type.kind) {
      case WireKind::boolean:
        if (!json.is_boolean())
          fail_kind(type, json, path);
        return {static_cast<std::uint8_t>(json.get<bool>())};
      case WireKind::float32:
        return bytes_of(static_cast<float>(number(type, json, path)));
      case WireKind::float64:
        return bytes_of(number(type, json, path));
      case WireKind::string: {
        if (!json.is_string())
          fail_kind(type, json, path);
        auto& text = json.get_ref<const std::string&>();
        return with_length({text.begin(), text.end()});
      }
      case WireKind::bytes: {
        auto data = json.is_string() ? from_base64(json.get_ref<const std::string&>())
                                     : std::optional<Bytes>{};
        if (!data)
          fail(path, "has to be base64 text, but it is " + kind_of(json) +
                       "; `castor wm get --full` prints byte fields as such");
        return with_length(*data);
      }
      case WireKind::list:
      case WireKind::array:
        return elements(type, json, path);
      case WireKind::optional:
        return optional(type, json, base, path);
      case WireKind::record: {
        if (++depth_ > deepest)
          fail(path, "is nested too deeply");
        auto& inner = descriptor_.records.at(type.index);
        Bytes result;
        if (base) {
          Decoder in{*base};
          Decoder fields{in.take(in.take_length())};
          result = record(inner, json, &fields, path);
        } else {
          result = record(inner, json, nullptr, path);
        }
        --depth_;
        return with_length(result);
      }
      case WireKind::enumeration:
        return enumerator(descriptor_.enums.at(type.index), json, path);
      default:
        return integer(type.kind, type, json, path);
    }
  }

  [[noreturn]] void fail_kind(const WireType& type, const Json& json,
                              const std::string& path) const {
    fail(path, "has to be " + type_text(descriptor_, type) + ", but it is " + kind_of(json));
  }

  double number(const WireType& type, const Json& json, const std::string& path) const {
    if (json.is_null())
      return std::numeric_limits<double>::quiet_NaN();
    if (!json.is_number())
      fail_kind(type, json, path);
    auto x = json.get<double>();
    if (!std::isfinite(x) || (type.kind == WireKind::float32 &&
                              std::abs(x) > static_cast<double>(std::numeric_limits<float>::max())))
      fail(path, "is too large for " + type_text(descriptor_, type));
    return x;
  }

  template <class T>
  Bytes integer_as(const WireType& type, const Json& json, const std::string& path) const {
    if (!json.is_number_integer())
      fail_kind(type, json, path);
    using Limits = std::numeric_limits<T>;
    bool fits = json.is_number_unsigned()
                  ? json.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max())
                  : json.get<std::int64_t>() >= static_cast<std::int64_t>(Limits::min());
    if (!fits)
      fail(path, "has to be between " + std::to_string(Limits::min()) + " and " +
                   std::to_string(Limits::max()) + ", but it is " + json.dump());
    return bytes_of(json.get<T>());
  }

  Bytes integer(WireKind kind, const WireType& type, const Json& json,
                const std::string& path) const {
    switch (kind) {
      case WireKind::int8:
        return integer_as<std::int8_t>(type, json, path);
      case WireKind::int16:
        return integer_as<std::int16_t>(type, json, path);
      case WireKind::int32:
        return integer_as<std::int32_t>(type, json, path);
      case WireKind::int64:
        return integer_as<std::int64_t>(type, json, path);
      case WireKind::uint8:
        return integer_as<std::uint8_t>(type, json, path);
      case WireKind::uint16:
        return integer_as<std::uint16_t>(type, json, path);
      case WireKind::uint32:
        return integer_as<std::uint32_t>(type, json, path);
      default:
        return integer_as<std::uint64_t>(type, json, path);
    }
  }

  Bytes enumerator(const EnumDescriptor& e, const Json& json, const std::string& path) const {
    std::vector<std::string_view> known;
    for (auto& [name, number] : e.enumerators) {
      known.push_back(name);
      if (json == name) {
        auto result = bytes_of(number);
        result.resize(*fixed_size(e.underlying));
        return result;
      }
    }
    auto given = json.is_string() ? json.get<std::string>() : std::string{};
    // A number without a name is printed as such.
    if (auto number = Json::parse(given, nullptr, false); number.is_number_integer())
      return integer(e.underlying, {e.underlying, 0, 0, {}}, number, path);
    fail(path, "has to be the name of an enumerator of " + e.name + ", but it is " +
                 (given.empty() ? kind_of(json) : '"' + given + '"') +
                 remedy(given, known, "there are: "));
  }

  Bytes optional(const WireType& type, const Json& json, const std::span<const std::uint8_t>* base,
                 const std::string& path) {
    if (json.is_null())
      return {0};
    std::span<const std::uint8_t> inner;
    bool is_there = base && base->front() != 0;
    if (is_there)
      inner = base->subspan(1);
    auto result = value(type.element.front(), json, is_there ? &inner : nullptr, path);
    result.insert(result.begin(), 1);
    return result;
  }

  /// Always as a whole, also where there is a base.
  Bytes elements(const WireType& type, const Json& json, const std::string& path) {
    if (!json.is_array())
      fail_kind(type, json, path);
    bool is_list = type.kind == WireKind::list;
    if (!is_list && json.size() != type.extent)
      fail(path, "has to have " + std::to_string(type.extent) + " elements, but it has " +
                   std::to_string(json.size()));
    if (++depth_ > deepest)
      fail(path, "is nested too deeply");
    Bytes result;
    if (is_list)
      result = bytes_of(static_cast<std::uint32_t>(json.size()));
    for (std::size_t i = 0; i < json.size(); ++i)
      append(result,
             value(type.element.front(), json[i], nullptr, path + '[' + std::to_string(i) + ']'));
    --depth_;
    return is_list ? with_length(result) : result;
  }

  const TypeDescriptor& descriptor_;
  int depth_ = 0;
};

Json example(const TypeDescriptor& descriptor, const WireType& type, int depth);

Json example(const TypeDescriptor& descriptor, const RecordDescriptor& record, int depth) {
  auto result = Json::object();
  for (auto& field : record.fields)
    result[field.name] = example(descriptor, field.type, depth);
  return result;
}

Json example(const TypeDescriptor& descriptor, const WireType& type, int depth) {
  switch (type.kind) {
    case WireKind::boolean:
      return false;
    case WireKind::float32:
    case WireKind::float64:
      return 0.0;
    case WireKind::string:
    case WireKind::bytes:
      return "";
    case WireKind::list:
      return Json::array();
    case WireKind::array: {
      auto result = Json::array();
      for (std::uint32_t i = 0; i < type.extent; ++i)
        result.push_back(example(descriptor, type.element.front(), depth));
      return result;
    }
    case WireKind::optional:
      return nullptr;
    case WireKind::record:
      if (depth >= deepest)
        return nullptr;
      return example(descriptor, descriptor.records.at(type.index), depth + 1);
    case WireKind::enumeration: {
      auto& e = descriptor.enums.at(type.index);
      return e.enumerators.empty() ? Json{} : Json(e.enumerators.front().first);
    }
    default:
      return 0;
  }
}

} // namespace

Value value_from_json(const TypeDescriptorPtr& type, const Json& json, const Value* base) {
  Bytes bytes;
  if (base) {
    Decoder in{base->bytes()};
    bytes = Writer{*type}.record(type->records.front(), json, &in, {});
  } else {
    bytes = Writer{*type}.record(type->records.front(), json, nullptr, {});
  }
  // Checked once more, as whatever comes from outside is.
  return Value::from_foreign_bytes(type, std::move(bytes));
}

Json example_of(const TypeDescriptor& type) {
  return example(type, type.records.front(), 0);
}

std::string type_text(const TypeDescriptor& descriptor, const WireType& type) {
  switch (type.kind) {
    case WireKind::boolean:
      return "true or false";
    case WireKind::float32:
    case WireKind::float64:
      return "a number";
    case WireKind::string:
      return "a text";
    case WireKind::bytes:
      return "base64 text";
    case WireKind::list:
      return "a list, each element " + type_text(descriptor, type.element.front());
    case WireKind::array:
      return "a list of " + std::to_string(type.extent) + ", each element " +
             type_text(descriptor, type.element.front());
    case WireKind::optional:
      return type_text(descriptor, type.element.front()) + ", or null";
    case WireKind::record:
      return "an object of the type " + descriptor.records.at(type.index).name;
    case WireKind::enumeration: {
      std::vector<std::string_view> names;
      for (auto& [name, number] : descriptor.enums.at(type.index).enumerators)
        names.push_back(name);
      return "one of " + joined(names);
    }
    default:
      return "an integer";
  }
}

} // namespace castor
