#include "castor/tools/cli/tethers.hpp"

#include "castor/actors/system/value_from_json.hpp"
#include "castor/binding/types.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace castor::cli {

namespace {

using binding::BinderStatus;
using binding::BindingProxy;
using binding::BindingUnion;
using binding::Feature;
using binding::FeatureKind;

/// Subarchitecture and id.
using Place = std::pair<std::string, std::string>;

/// An entry, or the address of one.
Place place_of(const Json& x) {
  return {x.at("subarchitecture"), x.at("id")};
}

Place place_of(const Address& x) {
  return {x.subarchitecture, x.id};
}

template <class T>
bool is(const Json& entry) {
  return entry.at("type") == type_name<T>();
}

/// The value of an entry of that type. Fields that are not shown have their defaults. Throws
/// ValueError.
template <class T>
std::shared_ptr<const T> value_of(const Json& entry) {
  const auto defaults = Value::of(T{});
  return value_from_json(descriptor_of<T>(), entry.at("value"), &defaults).template as<T>();
}

/// The pointers of a proxy to what it stands for.
std::vector<AnyEntryPointer> tethers_of(const Json& proxy) {
  std::vector<AnyEntryPointer> result;
  const auto value = value_of<BindingProxy>(proxy);
  for (auto& x : value->features)
    if (x.kind == FeatureKind::source_data)
      result.push_back(x.data);
  return result;
}

std::vector<AnyEntryPointer> all_tethers(const std::vector<Json>& entries) {
  std::vector<AnyEntryPointer> result;
  for (auto& x : entries)
    if (is<BindingProxy>(x))
      for (auto& tether : tethers_of(x))
        result.push_back(tether);
  return result;
}

/// All entries there are, and what leads from one to another.
class Tethers {
public:
  explicit Tethers(const std::vector<Json>& entries) {
    for (auto& x : entries)
      entries_.emplace(place_of(x), x);
    for (auto& x : entries)
      if (is<BindingProxy>(x))
        for (auto& tether : tethers_of(x))
          proxies_[place_of(tether.address)].push_back(place_of(x));
  }

  /// Null for what has nothing to do with binding.
  Json tree(const Json& root) const {
    if (is<BindingUnion>(root))
      return union_tree(root, {});
    if (is<BindingProxy>(root)) {
      auto result = with_data(root);
      add_union(result);
      return result;
    }
    auto tethered = proxies_.find(place_of(root));
    if (tethered == proxies_.end())
      return nullptr;
    auto result = root;
    result["proxies"] = Json::array();
    for (auto& x : tethered->second) {
      auto proxy = with_ends(entries_.at(x));
      add_union(proxy);
      result["proxies"].push_back(proxy);
    }
    return result;
  }

private:
  const Json* find(const std::string& subarchitecture, const std::string& id) const {
    auto i = entries_.find({subarchitecture, id});
    return i == entries_.end() ? nullptr : &i->second;
  }

  const Json* union_of(const Json& proxy) const {
    return find(proxy.at("subarchitecture"), value_of<BindingProxy>(proxy)->union_id);
  }

  /// `but` is the id of a proxy that is shown elsewhere.
  Json union_tree(const Json& entry, const std::string& but) const {
    auto result = with_ends(entry);
    result["proxies"] = Json::array();
    const auto value = value_of<BindingUnion>(entry);
    for (auto& id : value->proxy_ids)
      if (auto* proxy = find(entry.at("subarchitecture"), id); proxy && id != but)
        result["proxies"].push_back(with_data(*proxy));
    return result;
  }

  void add_union(Json& proxy) const {
    if (auto* bound_in = union_of(proxy))
      proxy["union"] = union_tree(*bound_in, proxy.at("id"));
  }

  Json with_data(const Json& proxy) const {
    auto result = with_ends(proxy);
    result["data"] = Json::array();
    for (auto& tether : tethers_of(proxy)) {
      auto& [subarchitecture, id] = tether.address;
      if (auto* data = find(subarchitecture, id))
        result["data"].push_back(*data);
      else
        result["data"].push_back({{"subarchitecture", subarchitecture},
                                  {"id", id},
                                  {"type", tether.type},
                                  {"gone", true}});
    }
    return result;
  }

  static std::vector<binding::Port> out_ports_of(const Json& entry) {
    return is<BindingUnion>(entry) ? value_of<BindingUnion>(entry)->out_ports
                                   : value_of<BindingProxy>(entry)->out_ports;
  }

  /// Of a relation.
  Json with_ends(const Json& entry) const {
    auto result = entry;
    for (auto& port : out_ports_of(entry)) {
      Json end{{"label", port.label}, {"proxy", port.proxy}};
      if (auto* proxy = find(entry.at("subarchitecture"), port.proxy))
        if (auto* bound_in = union_of(*proxy))
          end["union"] = *bound_in;
      // Of a union's members, most say the same.
      auto& ends = result["ends"];
      if (std::find(ends.begin(), ends.end(), end) == ends.end())
        ends.push_back(std::move(end));
    }
    return result;
  }

  std::map<Place, Json> entries_;
  /// By what they are tethered to.
  std::map<Place, std::vector<Place>> proxies_;
};

// -- for people

bool is_address(const Json& x) {
  return x.is_object() && x.size() == 2 && x.contains("subarchitecture") && x.contains("id");
}

std::string joined_address(const Json& x) {
  auto [subarchitecture, id] = place_of(x);
  return id.empty() ? std::string{} : subarchitecture + '/' + id;
}

std::string few_digits(double x) {
  // Nobody means -0.
  return fmt::format("{:.3g}", x == 0 ? 0 : x);
}

std::string few_digits(const Json& number) {
  return number.is_number_float() ? few_digits(number.get<double>()) : number.dump();
}

bool are_numbers(const Json& x) {
  return x.size() > 1 && std::all_of(x.begin(), x.end(), [](auto& y) { return y.is_number(); });
}

template <class Numbers>
std::string in_brackets(const Numbers& numbers) {
  std::vector<std::string> result;
  for (auto& x : numbers)
    result.push_back(few_digits(x));
  return fmt::format("({})", fmt::join(result, ", "));
}

/// What the fields of any entry say, the most telling first.
class EntrySummary {
public:
  explicit EntrySummary(const Json& value) { look("", value, 0); }

  std::string brief() const {
    std::vector<std::string> result;
    for (auto* part : {&words_, &places_, &numbers_, &nested_words_, &lists_})
      result.insert(result.end(), part->begin(), part->end());
    if (result.size() > most) {
      result.resize(most);
      result.emplace_back("...");
    }
    return fmt::format("{}", fmt::join(result, ", "));
  }

private:
  static constexpr std::size_t most = 6;
  static constexpr int deepest = 2;

  void look(const std::string& name, const Json& x, int depth) {
    if (x.is_string())
      add_word(name, x.get<std::string>(), depth);
    else if (x.is_boolean() && x == true)
      numbers_.push_back(name);
    else if (x.is_number())
      numbers_.push_back(name + ' ' + few_digits(x));
    else if (x.is_array() && !x.empty())
      lists_.push_back(fmt::format("{} {}", x.size(), name));
    else if (is_address(x))
      add_word(name, joined_address(x), depth);
    else if (x.is_object() && are_numbers(x))
      places_.push_back(name + ' ' + in_brackets(x));
    else if (x.is_object() && x.size() == 2 && x.contains("value") && x.contains("confidence"))
      words_.push_back(
        fmt::format("{} {} ({})", name, plain(x["value"]), few_digits(x["confidence"])));
    else if (x.is_object() && x.size() == 1 && x.contains("address"))
      look(name, x["address"], depth);
    else if (x.is_object() && depth < deepest)
      for (auto& [key, field] : x.items())
        look(name.empty() ? key : name + '.' + key, field, depth + 1);
  }

  static std::string plain(const Json& x) {
    return x.is_string() ? x.get<std::string>() : few_digits(x);
  }

  void add_word(const std::string& name, const std::string& word, int depth) {
    if (!word.empty())
      (depth > 1 ? nested_words_ : words_).push_back(name + ' ' + word);
  }

  std::vector<std::string> words_;
  /// Of fields of fields, such as the frame of a pose.
  std::vector<std::string> nested_words_;
  std::vector<std::string> places_;
  std::vector<std::string> numbers_;
  std::vector<std::string> lists_;
};

/// "concept name"
std::string in_words(FeatureKind kind) {
  std::string result;
  for (auto& [name, value] : castor_reflection(TypeTag<FeatureKind>{}).enumerators)
    if (value == kind)
      result = name;
  std::replace(result.begin(), result.end(), '_', ' ');
  return result;
}

/// Whether the feature is about binding, and not about the thing itself.
bool is_about_binding(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::source_data:
    case FeatureKind::source_id:
    case FeatureKind::other_source_id:
    case FeatureKind::this_proxy_id:
    case FeatureKind::creation_time:
      return true;
    default:
      return false;
  }
}

/// What proxies and unions say of the thing itself, each once.
std::string in_words(const std::vector<Feature>& features) {
  std::vector<std::string> result;
  for (auto& x : features) {
    if (is_about_binding(x.kind))
      continue;
    auto words = (x.negated ? "not " : "") + in_words(x.kind);
    if (!x.text.empty())
      words += ' ' + x.text;
    if (!x.numbers.empty())
      words += ' ' + in_brackets(x.numbers);
    if (std::find(result.begin(), result.end(), words) == result.end())
      result.push_back(std::move(words));
  }
  return fmt::format("{}", fmt::join(result, ", "));
}

std::string in_words(const Json& entry) {
  auto type = entry.at("type").get<std::string>();
  std::string what;
  if (entry.contains("gone"))
    what = "it is gone";
  else if (is<BindingUnion>(entry))
    what = in_words(value_of<BindingUnion>(entry)->features);
  else if (is<BindingProxy>(entry))
    what = in_words(value_of<BindingProxy>(entry)->features);
  else
    what = EntrySummary{entry.at("value")}.brief();
  return joined_address(entry) + "  " + type + (what.empty() ? "" : ": " + what);
}

class TreeText {
public:
  /// `ends_above` were just shown.
  void add(const Json& x, std::size_t depth, const Json& ends_above = Json::array()) {
    line(depth, in_words(x));
    auto ends = x.value("ends", Json::array());
    if (ends != ends_above)
      for (auto& end : ends)
        line(depth + 1, end_in_words(end));
    for (auto* key : {"data", "proxies"})
      for (auto& part : x.value(key, Json::array()))
        add(part, depth + 1, ends);
    if (x.contains("union"))
      add(x["union"], depth + 1, ends);
    else if (is<BindingProxy>(x) && value_of<BindingProxy>(x)->union_id.empty())
      line(depth + 1, "it is in no union yet");
  }

  std::string text;

private:
  static std::string end_in_words(const Json& end) {
    auto label = end.at("label").get<std::string>() + ": ";
    if (end.contains("union"))
      return label + in_words(end["union"]);
    return label + end.at("proxy").get<std::string>() + ", which is in no union";
  }

  void line(std::size_t depth, const std::string& words) {
    text += std::string(2 * depth, ' ') + words + '\n';
  }
};

} // namespace

bool is_of_binding(const std::string& type) {
  return type == type_name<BindingProxy>() || type == type_name<BindingUnion>() ||
         type == type_name<BinderStatus>();
}

std::vector<Json> unions_among(const std::vector<Json>& entries) {
  std::vector<Json> result;
  for (auto& x : entries)
    if (is<BindingUnion>(x))
      result.push_back(x);
  return result;
}

std::set<std::string> tethered_types(const std::vector<Json>& entries) {
  std::set<std::string> result;
  for (auto& x : all_tethers(entries))
    result.insert(x.address.subarchitecture + '/' + x.type);
  return result;
}

std::set<std::string> tethered_subarchitectures(const std::vector<Json>& entries) {
  std::set<std::string> result;
  for (auto& x : all_tethers(entries))
    result.insert(x.address.subarchitecture);
  return result;
}

std::vector<Json> follow_tethers(const std::vector<Json>& roots, const std::vector<Json>& entries) {
  Tethers tethers{entries};
  std::vector<Json> result;
  for (auto& x : roots)
    if (auto tree = tethers.tree(x); !tree.is_null())
      result.push_back(std::move(tree));
  return result;
}

std::string tethers_as_text(const std::vector<Json>& trees) {
  TreeText result;
  for (auto& x : trees) {
    if (!result.text.empty())
      result.text += '\n';
    result.add(x, 0);
  }
  return result.text;
}

} // namespace castor::cli
