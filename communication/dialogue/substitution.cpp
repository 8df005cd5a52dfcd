#include "castor/communication/dialogue/substitution.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace castor::communication {

namespace {

/// Of the table, or empty.
struct Sides {
  std::string_view depth;
  std::string_view width;

  /// \param place such as "left", "rightmost" or "back-left-corner"
  /// \returns whether it says a side
  bool note(std::string_view place) {
    bool says_side = false;
    const auto take = [&](std::string_view side, std::string_view& which) {
      if (place.find(side) == std::string_view::npos)
        return;
      which = side;
      says_side = true;
    };
    take("front", depth);
    take("back", depth);
    take("left", width);
    take("right", width);
    return says_side;
  }
};

/// Puts a fragment in the place of what is like it in a question: a thing for the thing that it is
/// about, a colour for a colour, a place for a place.
class Substitution {
public:
  Substitution(LogicalForm& form, const Nominal& fragment, const Vocabulary& vocabulary)
    : form_(form), fragment_(fragment), vocabulary_(vocabulary) {}

  /// \returns whether there is such a place
  bool run() {
    if (is_another_answer())
      return false;
    if (other_quality() || compared_quality() || contrast() || other_value() || other_selection())
      return true;
    if (dependent(form_, fragment_, "InsteadOf") != nullptr)
      return instead();
    if (other_corner() || other_patient() || other_of_noun())
      return true;
    for (const bool strictly : {true, false}) {
      is_strict_ = strictly;
      seen_.clear();
      visit(form_.root);
    }
    return replaced_;
  }

private:
  bool is_destination(const Nominal& x) const {
    return std::ranges::any_of(form_.nominals, [&](const Nominal& action) {
      return action.sort == "action" && dependent(form_, action, "Destination") == &x;
    });
  }

  /// A definite phrase is rather about what a definite phrase was about.
  bool is_alike(const Nominal& x) const {
    if (fragment_.sort == "thing")
      return x.sort == "thing" && vocabulary_.surroundings(x) == nullptr &&
             (!is_strict_ || is_definite(x) == is_definite(fragment_));
    // "Move it left. No, to the right": both say where.
    const auto is_place = [](const Nominal& y) { return y.sort == "region" || y.sort == "place"; };
    const bool is_where = is_place(fragment_) && is_place(x) && is_destination(x);
    return (x.sort == fragment_.sort || is_where) && x.name != fragment_.name;
  }

  /// "Which one is blue? And the other?" does not ask which other one is blue.
  bool is_another_answer() const {
    const auto* root = find_nominal(form_, form_.root);
    const auto* asked = root == nullptr ? nullptr : dependent(form_, *root, "Wh-Restr");
    return asked != nullptr && asked->sort == "thing" && fragment_.sort == "thing" &&
           is_definite(fragment_) && !is_plural(fragment_) && is_about_others(form_, fragment_) &&
           dependent(form_, *asked, "Quantity") == nullptr;
  }

  /// "Not the red one, the blue one": in the place of what is red.
  bool instead() {
    const auto not_meant = *dependent(form_, fragment_, "InsteadOf");
    std::erase_if(find_nominal(form_, fragment_.name)->relations,
                  [](auto& x) { return x.mode == "InsteadOf"; });
    const auto whole = part_of(form_, form_.root);
    const auto old = std::ranges::find_if(
      whole.nominals, [&](const Nominal& x) { return is_called(x, not_meant); });
    if (old == whole.nominals.end())
      return false;
    if (old->sort == "thing")
      inherit(*old);
    keep_anchor(*old);
    replace(old->name);
    return true;
  }

  /// Whether a phrase says all that the other one does.
  bool is_called(const Nominal& x, const Nominal& other) const {
    const bool is_same = x.proposition == other.proposition ||
                         (other.sort == "thing" && (other.proposition == "one" ||
                                                    vocabulary_.is_general(other.proposition)));
    return x.sort == other.sort && is_same &&
           std::ranges::all_of(other.relations, [&](const NominalRelation& said) {
             const auto* property = find_nominal(form_, said.dependent);
             const auto* own = dependent(form_, x, said.mode);
             return property != nullptr && own != nullptr &&
                    (is_pronoun(*property) || own->proposition == property->proposition);
           });
  }

  /// "Put a ball behind the cube. No, the other one": the other ball.
  bool other_patient() {
    const auto* root = find_nominal(form_, form_.root);
    const auto* patient =
      root == nullptr || root->sort != "action" ? nullptr : dependent(form_, *root, "Patient");
    if (patient == nullptr || patient->sort != "thing" || fragment_.sort != "thing" ||
        !is_definite(fragment_) || is_plural(fragment_) || !is_about_others(form_, fragment_) ||
        (fragment_.proposition != "one" && fragment_.proposition != patient->proposition &&
         !is_pronoun(*patient)))
      return false;
    const Nominal old = *patient;
    inherit(old);
    replace(old.name);
    return true;
  }

  /// "Put the ball next to the red cube. No, the green cube": in the place of the only other one
  /// that is called a cube.
  bool other_of_noun() {
    if (fragment_.sort != "thing" || feature(fragment_, "Corrects") != "true" ||
        fragment_.proposition == "one" || vocabulary_.is_general(fragment_.proposition))
      return false;
    const auto whole = part_of(form_, form_.root);
    const auto is_like = [&](const Nominal& x) {
      return x.sort == "thing" && x.name != fragment_.name && !is_pronoun(x) &&
             x.proposition == fragment_.proposition && is_plural(x) == is_plural(fragment_);
    };
    if (std::ranges::count_if(whole.nominals, is_like) != 1)
      return false;
    replace(std::ranges::find_if(whole.nominals, is_like)->name);
    return true;
  }

  /// "Put it in the corner. The one at the back on the left": the corner, not another thing.
  bool other_corner() {
    constexpr std::string_view corner = "corner";
    const auto* root = find_nominal(form_, form_.root);
    const auto* destination =
      root == nullptr || root->sort != "action" ? nullptr : dependent(form_, *root, "Destination");
    if (destination == nullptr || fragment_.proposition != "one" || fragment_.relations.empty())
      return false;
    const auto* anchor = dependent(form_, *destination, "Anchor");
    auto& place =
      find_nominal(form_, anchor == nullptr ? destination->name : anchor->name)->proposition;
    if (!place.ends_with(corner))
      return false;
    Sides sides;
    sides.note(place);
    for (const auto& [mode, property] : fragment_.relations) {
      const auto* said = find_nominal(form_, property);
      const bool is_side = (mode == "Location" || mode == "Selection") && said != nullptr &&
                           said->relations.empty() && sides.note(said->proposition);
      if (!is_side)
        return false;
    }
    if (sides.depth.empty() || sides.width.empty())
      return false;
    place = std::string{sides.depth} + '-' + std::string{sides.width} + '-' + std::string{corner};
    if (feature(fragment_, "Corrects") == "true")
      find_nominal(form_, destination->name)->features.push_back({"Corrects", "true"});
    return true;
  }

  /// "The red one" is a thing of the kind that was spoken of.
  void inherit(const Nominal& from) {
    auto* fragment = find_nominal(form_, fragment_.name);
    // "One of the balls" says of which kind it is.
    const auto* whole = dependent(form_, *fragment, "PartOf");
    const bool has_kind = whole != nullptr && whole->proposition != "one" && !is_pronoun(*whole);
    if (fragment->proposition == "one" && !is_pronoun(from) && !has_kind) {
      fragment->proposition = from.proposition;
      // "Take the ball. I meant the green one.": where no ball is green, the green thing.
      if (find_nominal(form_, form_.root)->sort == "action")
        fragment->features.push_back({"Called", "one"});
    }
    // "How many balls are red? And how many are green?" is about as many.
    if (feature(*fragment, "Delimitation").empty() && is_plural(*fragment))
      for (auto& relation : from.relations)
        if (relation.mode == "Quantity" || relation.mode == "PartOf")
          fragment->relations.push_back(relation);
  }

  /// "The colour of the cube? And the size?"
  bool other_quality() {
    auto* root = find_nominal(form_, form_.root);
    if (root == nullptr || root->sort != "quality" || fragment_.sort != "quality" ||
        !fragment_.relations.empty())
      return false;
    root->proposition = fragment_.proposition;
    return true;
  }

  /// "Are they the same colour? And size?"
  bool compared_quality() {
    const auto* root = find_nominal(form_, form_.root);
    const auto* scope = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Scope");
    const auto* quality = scope == nullptr ? nullptr : dependent(form_, *scope, "Quality");
    if (fragment_.sort != "quality" || !fragment_.relations.empty() || quality == nullptr)
      return false;
    replace(quality->name);
    return true;
  }

  /// "The cylinder is yellow, right? And large?" asks whether it is large.
  bool other_value() {
    const auto* root = find_nominal(form_, form_.root);
    const auto* scope = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Scope");
    if (!is_value(fragment_) || scope == nullptr || !is_value(*scope) ||
        scope->sort == fragment_.sort || dependent(form_, *root, "Wh-Restr") != nullptr)
      return false;
    replace(scope->name);
    return true;
  }

  /// "Which one is bigger? And the smaller one?" asks which is.
  bool other_selection() {
    const auto* root = find_nominal(form_, form_.root);
    const auto* scope = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Scope");
    const auto* selection = dependent(form_, fragment_, "Selection");
    if (scope == nullptr || scope->sort != "selection" || selection == nullptr ||
        fragment_.proposition != "one" || fragment_.relations.size() != 1 ||
        dependent(form_, *root, "Wh-Restr") == nullptr)
      return false;
    const auto old = scope->name;
    for (auto& relation : find_nominal(form_, form_.root)->relations)
      if (relation.dependent == old)
        relation.dependent = selection->name;
    return true;
  }

  /// "How many things are white? And brown ones?" asks how many are brown, "how many things are
  /// balls? And cubes?" how many are cubes: what a fragment excludes is not said of it.
  /// \returns whether it is like that
  bool contrast() {
    const auto* root = find_nominal(form_, form_.root);
    const auto* about = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Restr");
    const auto* scope = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Scope");
    if (about == nullptr || scope == nullptr || about->sort != "thing" ||
        fragment_.sort != "thing" || !is_plural(fragment_) ||
        (is_definite(fragment_) && dependent(form_, *root, "Wh-Restr") != about))
      return false;
    if (scope->sort == "thing") {
      if (!vocabulary_.is_general(about->proposition) ||
          vocabulary_.is_general(scope->proposition) ||
          vocabulary_.is_general(fragment_.proposition) || is_definite(*scope) ||
          is_definite(fragment_))
        return false;
      replace(scope->name);
      return true;
    }
    const auto of_kind = std::ranges::find_if(fragment_.relations, [&](auto& relation) {
      const auto* value = find_nominal(form_, relation.dependent);
      return value != nullptr && value->sort == scope->sort && is_value(*value);
    });
    if (of_kind == fragment_.relations.end() || !is_value(*scope))
      return false;
    const auto subject = about->name;
    const auto value = of_kind->dependent;
    auto& asked = *find_nominal(form_, subject);
    if (!vocabulary_.is_general(fragment_.proposition))
      asked.proposition = fragment_.proposition;
    for (auto& relation : fragment_.relations)
      if (relation.dependent != value)
        asked.relations.push_back(relation);
    const auto old = scope->name;
    for (auto& relation : find_nominal(form_, form_.root)->relations)
      if (relation.dependent == old)
        relation.dependent = value;
    return true;
  }

  static bool is_value(const Nominal& x) {
    return x.sort == "colour" || x.sort == "size" || x.sort == "shape" || x.sort == "material";
  }

  /// "What is behind the ball? And left of it?" is about the ball.
  void keep_anchor(const Nominal& old) {
    const auto* anchor = dependent(form_, old, "Anchor");
    for (auto& relation : find_nominal(form_, fragment_.name)->relations) {
      const auto* pronoun = find_nominal(form_, relation.dependent);
      if (anchor != nullptr && relation.mode == "Anchor" && pronoun != nullptr &&
          is_pronoun(*pronoun))
        relation.dependent = anchor->name;
    }
    // "And to the right?"
    auto& fragment = *find_nominal(form_, fragment_.name);
    if (anchor != nullptr && feature(fragment, "Of") == "before" &&
        dependent(form_, fragment, "Anchor") == nullptr &&
        vocabulary_.surroundings(*anchor) == nullptr)
      fragment.relations.push_back({"Anchor", anchor->name});
  }

  void visit(const std::string& name) {
    const auto* x = find_nominal(form_, name);
    if (x == nullptr || !seen_.insert(name).second || replaced_)
      return;
    for (std::size_t i = 0; i < x->relations.size() && !replaced_; ++i) {
      x = find_nominal(form_, name);
      const auto dependent = x->relations[i].dependent;
      const auto* to = find_nominal(form_, dependent);
      if (to != nullptr && dependent != fragment_.name && is_alike(*to)) {
        const Nominal old = *to;
        inherit(old);
        keep_anchor(old);
        replace(dependent);
        replaced_ = true;
      } else
        visit(dependent);
    }
  }

  void replace(const std::string& name) {
    for (auto& x : form_.nominals)
      if (x.name != fragment_.name)
        for (auto& relation : x.relations)
          if (relation.dependent == name)
            relation.dependent = fragment_.name;
  }

  LogicalForm& form_;
  const Nominal fragment_;
  const Vocabulary& vocabulary_;
  std::set<std::string> seen_;
  bool is_strict_ = true;
  bool replaced_ = false;
};

} // namespace

bool substitute_fragment(LogicalForm& form, const Nominal& fragment, const Vocabulary& vocabulary) {
  return Substitution{form, fragment, vocabulary}.run();
}

} // namespace castor::communication
