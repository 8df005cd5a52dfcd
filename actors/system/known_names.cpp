#include "castor/actors/system/known_names.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/filters/predicate_tree.hpp"
#include "castor/wm/values/field_access.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <variant>
#include <vector>

namespace castor {

namespace {

/// More names than this are not listed in a message.
constexpr std::size_t most_listed = 15;

std::set<std::string> names_of(const TypeCatalogue& types) {
  std::set<std::string> result;
  for (auto& [name, type] : types) {
    result.insert(name);
    result.insert(type->super_types.begin(), type->super_types.end());
  }
  return result;
}

[[noreturn]] void throw_unknown_type(const std::string& name, const TypeCatalogue& types) {
  throw std::runtime_error("there is no type " + name + nearest_known(name, names_of(types)));
}

/// The types that a filter for `name` can meet; all if it is empty.
std::vector<TypeDescriptorPtr> types_for(const std::string& name, const TypeCatalogue& types) {
  std::vector<TypeDescriptorPtr> result;
  for (auto& [other, type] : types)
    if (name.empty() || type->is_a(name))
      result.push_back(type);
  return result;
}

using Visit = std::function<void(const std::string& path, const FieldValue* literal)>;

/// Calls `visit` with every field of a predicate, and what it is compared with.
void visit_fields(const predicate::Node& node, const Visit& visit) {
  using namespace predicate;
  auto visit_point = [&](const std::variant<Path, Point>& x) {
    if (auto* path = std::get_if<Path>(&x))
      visit(path->text, nullptr);
  };
  auto visit_operand = [&](const Operand& x, const FieldValue* literal) {
    if (auto* path = std::get_if<Path>(&x))
      visit(path->text, literal);
    if (auto* distance = std::get_if<Distance>(&x)) {
      visit_point(distance->from);
      visit_point(distance->to);
    }
  };
  if (auto* condition = std::get_if<Condition>(&node.content)) {
    visit_operand(condition->left, std::get_if<FieldValue>(&condition->right));
    visit_operand(condition->right, nullptr);
  } else if (auto* presence = std::get_if<Presence>(&node.content)) {
    visit(presence->path.text, nullptr);
  } else if (auto* junction = std::get_if<Junction>(&node.content)) {
    for (auto& part : junction->parts)
      visit_fields(part, visit);
  } else if (auto* negation = std::get_if<Negation>(&node.content)) {
    for (auto& part : negation->part)
      visit_fields(part, visit);
  }
}

/// The names that may stand where a path leaves the type, and which stands there instead; nothing
/// if it does not.
std::pair<std::string, std::set<std::string>> wrong_step(const TypeDescriptor& type,
                                                         std::string_view path) {
  auto* record = &type.records.front();
  while (record) {
    auto dot = path.find('.');
    auto head = path.substr(0, dot);
    auto field = std::find_if(record->fields.begin(), record->fields.end(),
                              [&](auto& x) { return x.name == head; });
    if (field == record->fields.end()) {
      std::set<std::string> names;
      for (auto& x : record->fields)
        names.insert(x.name);
      return {std::string{head}, names};
    }
    auto* inner = &field->type;
    while (inner->kind == WireKind::optional)
      inner = &inner->element.front();
    record = inner->kind == WireKind::record ? &type.records.at(inner->index) : nullptr;
    if (dot == path.npos)
      break;
    path.remove_prefix(dot + 1);
  }
  return {};
}

void check_enumerator(const TypeDescriptor& type, const std::string& path,
                      const FieldValue& literal) {
  auto* text = std::get_if<std::string>(&literal);
  auto* wire = find_field(type, path).type;
  if (!text || wire->kind != WireKind::enumeration)
    return;
  std::set<std::string> names;
  auto& e = type.enums.at(wire->index);
  for (auto& [name, number] : e.enumerators)
    names.insert(name);
  if (names.count(*text) == 0)
    throw FieldError(path + " of " + type.name() + " is never \"" + *text + '"' +
                     nearest_known(*text, names));
}

/// Throws FieldError if the filter's fields are not those of the type.
void check_fields(const ChangeFilter& filter, const TypeDescriptor& type) {
  auto step = [&](const std::string& path) {
    auto [name, known] = wrong_step(type, path);
    if (!name.empty())
      throw FieldError(type.name() + " has no field " + path + nearest_known(name, known));
  };
  for (auto& name : filter.changing)
    step(name);
  if (filter.predicate.empty())
    return;
  visit_fields(*filter.predicate.tree(), [&](const std::string& path, const FieldValue* literal) {
    step(path);
    if (literal)
      check_enumerator(type, path, *literal);
  });
  filter.predicate.check(type);
}

void check_fields(const ChangeFilter& filter, const TypeCatalogue& known) {
  if (filter.changing.empty() && filter.predicate.empty())
    return;
  std::string problem;
  auto types = types_for(filter.type, known);
  for (auto& type : types) {
    try {
      check_fields(filter, *type);
      return;
    } catch (const FieldError& e) {
      // The type itself knows best what is wrong; the others only derive from it.
      if (problem.empty() || type->name() == filter.type)
        problem = e.what();
    }
  }
  if (!filter.type.empty())
    throw std::runtime_error(problem);
  std::set<std::string> fields;
  for (auto& type : types)
    for (auto& field : type->records.front().fields)
      fields.insert(field.name);
  auto check = [&](const std::string& path) {
    auto name = path.substr(0, path.find('.'));
    if (fields.count(name) == 0)
      throw std::runtime_error("no type has a field " + name + nearest_known(name, fields));
  };
  for (auto& name : filter.changing)
    check(name);
  if (!filter.predicate.empty())
    visit_fields(*filter.predicate.tree(),
                 [&](const std::string& path, const FieldValue*) { check(path); });
  throw std::runtime_error("no known type has all fields that the filter uses: " +
                           to_string(filter) + ". Name the type in the filter");
}

} // namespace

std::string nearest_known(std::string_view name, const std::set<std::string>& known) {
  std::vector<std::string_view> names{known.begin(), known.end()};
  auto guess = did_you_mean(name, names);
  if (!guess.empty())
    return "; " + guess;
  if (names.empty())
    return "; there are none";
  return "; there are: " + list_of(names, most_listed);
}

bool is_known_type(const std::string& name, const TypeCatalogue& types) {
  return names_of(types).count(name) > 0;
}

TypeDescriptorPtr find_type(const std::string& name, const TypeCatalogue& types) {
  if (auto i = types.find(name); i != types.end())
    return i->second;
  if (!is_known_type(name, types))
    throw_unknown_type(name, types);
  return nullptr;
}

void check_names(const ChangeFilter& filter, const KnownNames& known) {
  if (!filter.type.empty())
    find_type(filter.type, known.types);
  if (auto& name = filter.subarchitecture;
      name && !name->empty() && known.subarchitectures.count(*name) == 0)
    throw std::runtime_error("there is no subarchitecture " + *name +
                             nearest_known(*name, known.subarchitectures));
  if (!filter.source.empty() && !known.sources.empty() && known.sources.count(filter.source) == 0)
    throw std::runtime_error("there is no component " + filter.source +
                             nearest_known(filter.source, known.sources));
  check_fields(filter, known.types);
}

} // namespace castor
