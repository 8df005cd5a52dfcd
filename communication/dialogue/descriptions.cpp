#include "castor/communication/dialogue/descriptions.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using binding::Feature;
using binding::FeatureKind;

constexpr std::array pronouns{"it", "this", "that", "they", "these", "those"};

/// Makes one description, thing after thing.
class Describer {
public:
  Describer(const LogicalForm& form, const Vocabulary& words) : form_(form), words_(words) {}

  /// What is described by the nominal, and its number.
  std::uint32_t thing(const Nominal& nominal) {
    auto known = numbers_.find(nominal.name);
    if (known != numbers_.end())
      return known->second;
    auto number = new_thing();
    fill(number, nominal);
    return number;
  }

  /// The thing with that number is like this, too.
  void ascribe(std::uint32_t number, const Nominal& scope) {
    if (scope.sort == "conjunction")
      conjoin(number, scope);
    else if (scope.sort == "region")
      locate(number, scope);
    else if (scope.sort == "comparison" || scope.sort == "selection" || is_negated(scope))
      result_.not_understood.push_back(scope.proposition);
    else if (scope.sort == "thing" || scope.sort == "entity") {
      call(number, scope);
      modify(number, scope);
    } else if (scope.sort == "composition")
      follow(number, scope, "Material");
    else
      property(number, scope);
  }

  PhraseMeaning result() && {
    for (auto& thing : result_.description.things)
      leave_out_general_kind(thing.features, words_);
    return std::move(result_);
  }

private:
  std::uint32_t new_thing() {
    result_.description.things.emplace_back();
    return static_cast<std::uint32_t>(result_.description.things.size() - 1);
  }

  void fill(std::uint32_t number, const Nominal& nominal) {
    numbers_.emplace(nominal.name, number);
    say(number, feature(FeatureKind::concept_name, words_.general_concept()));
    call(number, nominal);
    modify(number, nominal);
  }

  void say(std::uint32_t number, Feature x) {
    auto& features = result_.description.things[number].features;
    if (std::find(features.begin(), features.end(), x) == features.end())
      features.push_back(std::move(x));
  }

  void relate(const std::string& label, std::uint32_t from, std::uint32_t to) {
    result_.description.relations.push_back({label, from, to});
  }

  /// What its noun says.
  void call(std::uint32_t number, const Nominal& nominal) {
    auto& noun = nominal.proposition;
    if (is_pronoun(nominal))
      return;
    const auto& definition = words_.definition(noun);
    for (const auto& x : definition)
      say(number, x);
    if (definition.empty() && !words_.is_general(noun))
      say(number, feature(FeatureKind::concept_name, words_.concept_of(noun)));
  }

  /// What its adjectives and its relative clauses say.
  void modify(std::uint32_t number, const Nominal& nominal) {
    for (auto& [mode, name] : nominal.relations) {
      const auto* dependent = find_nominal(form_, name);
      if (dependent == nullptr || mode == "Quantity")
        continue;
      if (mode == "GenRelation") {
        // "That you see" says nothing new.
        if (dependent->proposition != "see")
          result_.not_understood.push_back(dependent->proposition);
      } else if (mode == "Selection" || mode == "Owner" || mode == "Accompaniment")
        result_.not_understood.push_back(dependent->proposition);
      else
        ascribe(number, *dependent);
    }
  }

  void follow(std::uint32_t number, const Nominal& from, std::string_view mode) {
    if (const auto* dependent = communication::dependent(form_, from, mode))
      ascribe(number, *dependent);
  }

  void conjoin(std::uint32_t number, const Nominal& scope) {
    if (scope.proposition != "and") {
      result_.not_understood.push_back(scope.proposition);
      return;
    }
    follow(number, scope, "First");
    follow(number, scope, "Next");
  }

  void property(std::uint32_t number, const Nominal& x) {
    auto kind = words_.kind_of_quality(x.sort);
    auto word = words_.value_of(x.sort, x.proposition);
    if (kind && word)
      say(number, feature(*kind, *word));
    else if (x.proposition != "other")
      result_.not_understood.push_back(x.proposition);
  }

  /// Objects are related by the places where they are.
  void locate(std::uint32_t number, const Nominal& region) {
    const auto* anchor = dependent(form_, region, "Anchor");
    if (anchor != nullptr && anchor->sort == "conjunction") {
      for (const auto* mode : {"First", "Next"})
        if (const auto* one = dependent(form_, *anchor, mode))
          locate(number, region, *one);
    } else if (anchor != nullptr)
      locate(number, region, *anchor);
    else
      result_.not_understood.push_back(region.proposition);
  }

  void locate(std::uint32_t number, const Nominal& region, const Nominal& anchor) {
    auto relation = words_.relation_of(region.proposition);
    const auto* everywhere = words_.surroundings(anchor);
    if (everywhere != nullptr && everywhere->is_said_by(region.proposition))
      return;
    if (!relation || everywhere != nullptr) {
      result_.not_understood.push_back(region.proposition);
      return;
    }
    auto place = place_of(number);
    auto other = numbers_.find(anchor.name);
    auto other_place = other == numbers_.end() ? new_thing() : place_of(other->second);
    relate(*relation, place, other_place);
    if (other == numbers_.end()) {
      auto landmark = new_thing();
      places_.emplace(landmark, other_place);
      relate(binding::position_label, other_place, landmark);
      fill(landmark, anchor);
    }
  }

  std::uint32_t place_of(std::uint32_t number) {
    auto known = places_.find(number);
    if (known != places_.end())
      return known->second;
    auto place = new_thing();
    places_.emplace(number, place);
    relate(binding::position_label, place, number);
    return place;
  }

  const LogicalForm& form_;
  const Vocabulary& words_;
  std::map<std::string, std::uint32_t> numbers_;
  std::map<std::uint32_t, std::uint32_t> places_;
  PhraseMeaning result_;
};

/// Collects things, those first that are spoken of first.
class ThingCollector {
public:
  ThingCollector(const LogicalForm& form, const Vocabulary& words) : form_(form), words_(words) {}

  void visit(const std::string& name) {
    const auto* nominal = find_nominal(form_, name);
    if (nominal == nullptr || !seen_.insert(name).second)
      return;
    if (nominal->sort == "thing" && words_.surroundings(*nominal) == nullptr)
      things.push_back(nominal);
    // What "this is a ball" says of "this" is no other thing.
    if (nominal->sort == "ascription") {
      if (const auto* scope = dependent(form_, *nominal, "Cop-Scope");
          scope != nullptr && scope->sort == "thing") {
        seen_.insert(scope->name);
        for (auto& relation : scope->relations)
          later_.push_back(relation.dependent);
      }
    }
    for (auto& relation : nominal->relations)
      visit(relation.dependent);
    for (auto& left : std::exchange(later_, {}))
      visit(left);
  }

  std::vector<const Nominal*> things;

private:
  const LogicalForm& form_;
  const Vocabulary& words_;
  std::set<std::string> seen_;
  std::vector<std::string> later_;
};

} // namespace

void leave_out_general_kind(std::vector<Feature>& features, const Vocabulary& words) {
  const bool is_other = std::ranges::any_of(features, [&](auto& x) {
    return x.kind == FeatureKind::concept_name && !x.negated &&
           words.ontology().excludes(x.text, words.general_concept());
  });
  if (is_other)
    std::erase_if(features, [&](auto& x) {
      return x.kind == FeatureKind::concept_name && x.text == words.general_concept();
    });
}

bool is_pronoun(const Nominal& nominal) {
  return nominal.sort == "thing" &&
         std::find(pronouns.begin(), pronouns.end(), nominal.proposition) != pronouns.end();
}

bool is_definite(const Nominal& nominal) {
  return is_pronoun(nominal) || feature(nominal, "Delimitation") == "unique";
}

bool is_definite_phrase(const Nominal& nominal) {
  const auto delimitation = feature(nominal, "Delimitation");
  return is_definite(nominal) || delimitation == "both" || delimitation == "neither";
}

bool is_deictic(const Nominal& nominal) {
  return is_pronoun(nominal) && nominal.proposition != "it" && nominal.proposition != "they";
}

bool is_participant(const Nominal& nominal) {
  return nominal.sort == "person" && (nominal.proposition == "i" || nominal.proposition == "you" ||
                                      nominal.proposition == "we");
}

std::size_t place_of_word(const Nominal& nominal) {
  std::size_t place = 0;
  const auto digits = nominal.name.substr(std::min<std::size_t>(1, nominal.name.size()));
  std::from_chars(digits.data(), digits.data() + digits.size(), place);
  return place;
}

bool is_anaphoric(const Nominal& nominal, const Vocabulary& words) {
  return nominal.sort == "thing" && !feature(nominal, "Proximity").empty() &&
         words.is_general(nominal.proposition);
}

bool is_about_others(const LogicalForm& form, const Nominal& x) {
  return std::ranges::any_of(x.relations, [&form](auto& relation) {
    const auto* property = find_nominal(form, relation.dependent);
    return relation.mode == "Property" && property != nullptr && property->proposition == "other";
  });
}

bool is_counted_group(const LogicalForm& form, const Nominal& nominal) {
  return nominal.sort == "thing" && nominal.proposition == "one" && is_definite(nominal) &&
         is_plural(nominal) && nominal.relations.size() == 1 &&
         dependent(form, nominal, "Quantity") != nullptr;
}

bool asks_for_number(const Nominal& nominal) {
  return std::ranges::any_of(nominal.relations,
                             [](auto& relation) { return relation.mode == "Quantity"; });
}

bool is_whole(const LogicalForm& form, const Nominal& nominal) {
  return std::ranges::any_of(form.nominals, [&nominal](auto& x) {
    return std::ranges::any_of(x.relations, [&nominal](auto& relation) {
      return relation.mode == "PartOf" && relation.dependent == nominal.name;
    });
  });
}

PhraseMeaning describe_as(const LogicalForm& form, const Nominal& phrase, const Nominal& scope,
                          const Vocabulary& words) {
  Describer describer{form, words};
  describer.ascribe(describer.thing(phrase), scope);
  return std::move(describer).result();
}

std::vector<Feature> features_of(const LogicalForm& form, const Nominal& scope,
                                 const Vocabulary& words) {
  const Nominal anything{"", "thing", words.general_concept(), {}, {}};
  auto meaning = describe_as(form, anything, scope, words);
  return meaning.description.things.front().features;
}

std::vector<const Nominal*> things_spoken_of(const LogicalForm& form, const Vocabulary& words) {
  ThingCollector collector{form, words};
  collector.visit(form.root);
  return std::move(collector.things);
}

} // namespace castor::communication
