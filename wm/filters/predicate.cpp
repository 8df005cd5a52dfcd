#include "castor/wm/filters/predicate.hpp"

#include "castor/wm/filters/bound_predicate.hpp"
#include "castor/wm/filters/predicate_parser.hpp"
#include "castor/wm/filters/predicate_tree.hpp"

#include <utility>

namespace castor {

namespace {

Predicate join(bool all, const Predicate& a, const Predicate& b) {
  return Predicate{predicate::junction(all, {*a.tree(), *b.tree()})};
}

} // namespace

struct Predicate::Rep {
  predicate::Node tree;
  std::string text;
};

Predicate::Predicate(predicate::Node tree) {
  if (predicate::depth(tree) > predicate::max_depth)
    throw PredicateError("a predicate may nest no deeper than " +
                         std::to_string(predicate::max_depth));
  auto text = predicate::to_string(tree);
  if (text.size() > predicate::max_text)
    throw PredicateError("a predicate of " + std::to_string(text.size()) +
                         " characters is too long; the limit is " +
                         std::to_string(predicate::max_text));
  rep_ = std::make_shared<const Rep>(Rep{std::move(tree), std::move(text)});
}

Predicate Predicate::parse(std::string_view text) {
  auto tree = parse_predicate(text);
  return tree ? Predicate{*std::move(tree)} : Predicate{};
}

const std::string& Predicate::text() const {
  static const std::string nothing;
  return rep_ ? rep_->text : nothing;
}

const predicate::Node* Predicate::tree() const {
  return rep_ ? &rep_->tree : nullptr;
}

void Predicate::check(const TypeDescriptor& type) const {
  BoundPredicate{tree(), type};
}

bool Predicate::matches(const Value& x) const {
  auto bound = BoundPredicate::try_bind(tree(), x.type());
  return bound && bound->matches(x);
}

Predicate operator&&(const Predicate& a, const Predicate& b) {
  if (a.empty() || b.empty())
    return a.empty() ? b : a;
  return join(true, a, b);
}

Predicate operator||(const Predicate& a, const Predicate& b) {
  if (a.empty() || b.empty())
    return {};
  return join(false, a, b);
}

Predicate Predicate::operator!() const {
  if (empty())
    throw PredicateError("the negation of the empty predicate would be true of nothing");
  return Predicate{predicate::negation(*tree())};
}

} // namespace castor
