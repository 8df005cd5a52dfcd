#include "castor/communication/parsing/packing.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

using Ids = std::vector<std::int32_t>;

bool contains(std::span<const std::int32_t> ids, std::int32_t id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// Notes that an alternative belongs to a reading; adds it if no reading had it.
template <class T>
void add(std::vector<T>& alternatives, T alternative, std::int32_t reading) {
  for (auto& known : alternatives) {
    alternative.readings = known.readings;
    if (known == alternative) {
      if (!contains(known.readings, reading))
        known.readings.push_back(reading);
      return;
    }
  }
  alternative.readings = {reading};
  alternatives.push_back(std::move(alternative));
}

void add(PackedNominal& packed, const Nominal& nominal, std::int32_t reading) {
  if (!nominal.sort.empty())
    add(packed.sorts, PackedValue{nominal.sort, {}}, reading);
  if (!nominal.proposition.empty())
    add(packed.propositions, PackedValue{nominal.proposition, {}}, reading);
  for (const auto& feature : nominal.features)
    add(packed.features, PackedFeature{feature.name, feature.value, {}}, reading);
  for (const auto& relation : nominal.relations)
    add(packed.relations, PackedRelation{relation.mode, relation.dependent, {}}, reading);
}

template <class T>
void remove(std::vector<T>& alternatives, std::span<const std::int32_t> readings) {
  for (auto& alternative : alternatives)
    std::erase_if(alternative.readings,
                  [readings](std::int32_t id) { return contains(readings, id); });
  std::erase_if(alternatives, [](const T& alternative) { return alternative.readings.empty(); });
}

bool is_empty(const PackedNominal& nominal) {
  return nominal.sorts.empty() && nominal.propositions.empty() && nominal.features.empty() &&
         nominal.relations.empty();
}

/// A nominal of which nothing is said stays where something leads to it.
void remove_unused_nominals(PackedLogicalForm& packed) {
  const auto is_used = [&packed](const std::string& name) {
    const auto leads_to = [&name](const PackedRelation& relation) {
      return relation.dependent == name;
    };
    return std::any_of(packed.roots.begin(), packed.roots.end(),
                       [&name](const PackedValue& root) { return root.value == name; }) ||
           std::any_of(
             packed.nominals.begin(), packed.nominals.end(), [&](const PackedNominal& nominal) {
               return std::any_of(nominal.relations.begin(), nominal.relations.end(), leads_to);
             });
  };
  std::vector<std::string> unused;
  for (const auto& nominal : packed.nominals)
    if (is_empty(nominal) && !is_used(nominal.name))
      unused.push_back(nominal.name);
  std::erase_if(packed.nominals, [&unused](const PackedNominal& nominal) {
    return std::find(unused.begin(), unused.end(), nominal.name) != unused.end();
  });
}

/// What a root leads to in a reading.
class Unpacking {
public:
  Unpacking(const PackedLogicalForm& packed, std::int32_t reading)
    : packed_(packed), reading_(reading) {
    // nop
  }

  LogicalForm form(const std::string& root) const {
    LogicalForm form;
    form.root = root;
    std::vector<std::string> names = {root};
    for (std::size_t i = 0; i < names.size(); ++i) {
      form.nominals.push_back(nominal(names[i]));
      for (const auto& relation : form.nominals.back().relations)
        if (std::find(names.begin(), names.end(), relation.dependent) == names.end())
          names.push_back(relation.dependent);
    }
    return form;
  }

private:
  template <class T>
  const T* first(const std::vector<T>& alternatives) const {
    for (const auto& alternative : alternatives)
      if (contains(alternative.readings, reading_))
        return &alternative;
    return nullptr;
  }

  Nominal nominal(const std::string& name) const {
    Nominal nominal;
    nominal.name = name;
    for (const auto& packed : packed_.nominals) {
      if (packed.name != name)
        continue;
      if (const auto* sort = first(packed.sorts))
        nominal.sort = sort->value;
      if (const auto* proposition = first(packed.propositions))
        nominal.proposition = proposition->value;
      for (const auto& feature : packed.features)
        if (contains(feature.readings, reading_))
          nominal.features.push_back({feature.name, feature.value});
      for (const auto& relation : packed.relations)
        if (contains(relation.readings, reading_))
          nominal.relations.push_back({relation.mode, relation.dependent});
    }
    return nominal;
  }

  const PackedLogicalForm& packed_;
  std::int32_t reading_;
};

} // namespace

PackedLogicalForm pack(std::span<const ReadingForms> readings) {
  PackedLogicalForm packed;
  std::int32_t id = 0;
  for (const auto& forms : readings) {
    double preference = 0;
    for (const auto& form : forms) {
      preference += form.preference;
      add(packed.roots, PackedValue{form.root, {}}, id);
      for (const auto& nominal : form.nominals) {
        auto place = std::find_if(
          packed.nominals.begin(), packed.nominals.end(),
          [&nominal](const PackedNominal& known) { return known.name == nominal.name; });
        if (place == packed.nominals.end()) {
          packed.nominals.push_back({nominal.name, {}, {}, {}, {}});
          place = packed.nominals.end() - 1;
        }
        add(*place, nominal, id);
      }
    }
    packed.readings.push_back({id++, preference});
  }
  return packed;
}

bool is_understood(const PackedLogicalForm& form) {
  return form.unparsable.empty() && !form.readings.empty();
}

ReadingForms unpack(const PackedLogicalForm& packed, std::int32_t reading) {
  ReadingForms forms;
  for (const auto& known : packed.readings) {
    if (known.id != reading)
      continue;
    for (const auto& root : packed.roots)
      if (contains(root.readings, reading)) {
        forms.push_back(Unpacking(packed, reading).form(root.value));
        forms.back().preference = known.preference;
      }
  }
  return forms;
}

void remove_readings(PackedLogicalForm& packed, std::span<const std::int32_t> readings) {
  std::erase_if(packed.readings,
                [readings](const Reading& reading) { return contains(readings, reading.id); });
  remove(packed.roots, readings);
  for (auto& nominal : packed.nominals) {
    remove(nominal.sorts, readings);
    remove(nominal.propositions, readings);
    remove(nominal.features, readings);
    remove(nominal.relations, readings);
  }
  remove_unused_nominals(packed);
}

bool prune(PackedLogicalForm& packed, std::span<const InterpretationSupport> supports) {
  Ids unsupported;
  for (const auto& support : supports) {
    if (support.supported)
      continue;
    for (const auto& nominal : packed.nominals)
      for (const auto& relation : nominal.relations)
        if (nominal.name == support.head && relation.mode == support.mode &&
            relation.dependent == support.dependent)
          for (const auto id : relation.readings)
            if (!contains(unsupported, id))
              unsupported.push_back(id);
  }
  if (unsupported.empty() || unsupported.size() >= packed.readings.size())
    return false;
  remove_readings(packed, unsupported);
  if (packed.state == InterpretationState::finished)
    packed.state = InterpretationState::pruned;
  return true;
}

} // namespace castor::communication
