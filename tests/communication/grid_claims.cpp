#include "castor/tests/communication/grid_maker.hpp"

#include <algorithm>

namespace castor::communication::test {

using namespace oracle;

void GridMaker::claims() {
  existence();
  existence_of_several();
  indefinite_pronouns();
  definite_subjects();
  quantified_subjects();
  several_subjects();
}

// -- existence

void GridMaker::existence() {
  auto of_things = nouns();
  for (auto& n : nouns())
    for (auto& place : places())
      of_things.push_back(with_place(n, place));
  for (auto& n : nouns())
    for (auto& scope : scopes_of_several())
      for (bool is_so : {true, false})
        if (scope.is_plain || is_so)
          of_things.push_back(that_is(n, scope, is_so));
  const Scope so{"", "", anything()};
  const auto ask = [&](const char* form, std::size_t least = 1, std::size_t most = 1000) {
    for (auto& n : of_things)
      add(Kind::whether, form, fill(form, n), n.needs, there_is(n.is, least, most));
  };
  ask("Is there a <N>?");
  ask("Is there any <N>?");
  ask("Is there no <N>?", 0, 0);
  ask("Isn't there a <N>?");
  ask("Is there not a <N>?");
  ask("Do you see a <N>?");
  ask("Can you see any <Ns>?");
  ask("Is there one <N>?", 1, 1);
  ask("Is there only one <N>?", 1, 1);
  ask("Is there exactly one <N>?", 1, 1);
  ask("Is there at least one <N>?", 1);
  ask("Is there more than one <N>?", 2);
  ask("Are there <Ns>?");
  ask("Are there any <Ns>?");
  ask("Are there some <Ns>?");
  ask("Are there no <Ns>?", 0, 0);
  ask("Aren't there any <Ns>?");
  ask("Are there two <Ns>?", 2, 2);
  ask("Are there three <Ns>?", 3, 3);
  ask("Are there exactly two <Ns>?", 2, 2);
  ask("Are there only two <Ns>?", 2, 2);
  ask("Are there at least two <Ns>?", 2);
  ask("Are there at most two <Ns>?", 0, 2);
  ask("Are there more than two <Ns>?", 3);
  ask("Are there fewer than two <Ns>?", 0, 1);
  ask("Are there less than three <Ns>?", 0, 2);
  ask("Are there several <Ns>?", 2);
  ask("Do you see two <Ns>?", 2, 2);
  ask("Aren't there two <Ns>?", 2, 2);
}

void GridMaker::existence_of_several() {
  for (auto& a : nouns())
    for (auto& b : nouns()) {
      if (a.singular == b.singular)
        continue;
      const auto ask = [&](const std::string& form, const Claim& claim) {
        add(Kind::whether, form,
            replaced(replaced(fill(form, a), "<Ms>", b.plural), "<M>", b.singular), {}, claim);
      };
      auto first = there_is(a.is);
      auto second = there_is(b.is);
      ask("Are there <Ns> and <Ms>?", both_so(first, second));
      ask("Are there <Ns> or <Ms>?", either_so(first, second));
      ask("Is there a <N> and a <M>?", both_so(first, second));
      ask("Is there a <N> or a <M>?", either_so(first, second));
      ask("Is there both a <N> and a <M>?", both_so(first, second));
      ask("Is there neither a <N> nor a <M>?", both_so(not_so(first), not_so(second)));
      ask("Are there two <Ns> and a <M>?", both_so(there_is(a.is, 2, 2), second));
      ask("Is there a <N> but no <M>?", both_so(first, not_so(second)));
      const auto third = there_is(has_shape("pyramid"));
      ask("Is there a <N>, a <M> and a pyramid?", both_so(both_so(first, second), third));
      ask("Is there a <N>, a <M> or a pyramid?", either_so(either_so(first, second), third));
      const auto more = [](const NounPhrase& x, const NounPhrase& than) -> Claim {
        return [=](auto& world) {
          auto some = number_of(world, x.is);
          auto others = number_of(world, than.is);
          if (some.least > others.most)
            return Verdict::yes;
          return some.most <= others.least ? Verdict::no : Verdict::unknown;
        };
      };
      ask("Are there more <Ns> than <Ms>?", more(a, b));
      ask("Are there fewer <Ns> than <Ms>?", more(b, a));
      ask("Are there as many <Ns> as <Ms>?", both_so(not_so(more(a, b)), not_so(more(b, a))));
    }
}

// -- predication

void GridMaker::indefinite_pronouns() {
  auto things = noun("thing");
  for (auto& p : scopes_of_several()) {
    const auto ask = [&](const Quantifier& q, const std::string& form) {
      add_quantified(Kind::whether, form, q, things, p);
    };
    ask(some("anything", false), "Is <Q> <P>?");
    ask(some("something", false), "Is <Q> <P>?");
    ask(none("nothing", false), "Is <Q> <P>?");
    ask(all("everything", false), "Is <Q> <P>?");
    ask(some("anything", false), "Isn't <Q> <P>?");
    ask(some("anything", false), "Is there <Q> that is <P>?");
    ask(some("something", false), "Is there <Q> that is <P>?");
    ask(none("nothing", false), "Is there <Q> that is <P>?");
  }
  for (auto& p : scopes_of_several())
    if (p.is_plain)
      add_quantified(Kind::whether, "Is there <Q> that is not <P>?", some("anything", false),
                     things, {p.singular, p.plural, no_such(p).is, p.needs, p.landmark, false});
  for (auto& p : places()) {
    add_quantified(Kind::whether, "Is there <Q> <P>?", some("something", false), things, p);
    add_quantified(Kind::whether, "Is there <Q> <P>?", some("anything", false), things, p);
    add_quantified(Kind::whether, "Is there <Q> <P>?", none("nothing", false), things, p);
    add_quantified(Kind::whether, "Do you see <Q> <P>?", some("anything", false), things, p);
    for (const auto* colour : {"red", "small"}) {
      auto here = with_place(things, p);
      auto every = all("every", false);
      add(Kind::whether, "Is everything <place> <P>?",
          "Is everything " + p.singular + ' ' + colour + '?',
          together(here.needs, {at_least_one(here.is)}),
          [=](auto& world) { return every.holds(world, here.is, adjective(colour).is); });
    }
  }
}

void GridMaker::definite_subjects() {
  for (auto& n : nouns())
    for (auto& p : scopes()) {
      const auto ask = [&](const std::string& form, const Claim& claim, Kind kind = Kind::whether) {
        add(kind, form, fill(form, n, &p),
            together({exactly_one(n.is)}, together(n.needs, p.needs)), claim, n.is);
        odd_if_any(all_of({n.is, p.landmark}));
      };
      const Claim so = [n, p](auto& world) {
        return is_from_to(number_of(world, all_of({n.is, p.is})), 1, 1000);
      };
      const Claim only = [n, p](auto& world) {
        return is_from_to(number_of(world, all_of({is_not(n.is), p.is})), 0, 0);
      };
      ask("Is the <N> <P>?", so);
      ask("The <N> is <P>.", so, Kind::statement);
      ask("Is only the <N> <P>?", both_so(so, only));
      ask("Only the <N> is <P>.", both_so(so, only), Kind::statement);
      ask("Is it true that the <N> is <P>?", so);
      ask("The <N> is <P>, right?", so);
      ask("The <N> is <P>, isn't it?", so);
      ask("The <N>: is it <P>?", so);
      ask("The <N> is it <P>?", so);
      if (!p.is_plain)
        continue;
      ask("Is the <N> not <P>?", not_so(so));
      ask("Isn't the <N> <P>?", so);
      ask("The <N> is not <P>.", not_so(so), Kind::statement);
      ask("The <N> isn't <P>.", not_so(so), Kind::statement);
      ask("Is it false that the <N> is <P>?", not_so(so));
    }
  // What there may be one of only.
  for (auto& n : nouns())
    for (auto& p : {the_most("the largest", by_size(true), "thing"),
                    the_most("the largest", by_size(true), "cube"),
                    the_most("the smallest", by_size(false), "thing"),
                    the_most("the leftmost", from_the_left(), "thing")})
      add(Kind::whether, "Is the <N> the largest <M>?",
          "Is the " + n.singular + ' ' + p.singular + '?', together({exactly_one(n.is)}, p.needs),
          there_is(all_of({n.is, p.is})), n.is);
}

void GridMaker::quantified_subjects() {
  const std::vector<Quantifier> quantifiers{all("every", false),
                                            all("each", false),
                                            all("all", true),
                                            all("all the", true),
                                            all("the", true),
                                            of_the(all("all", true)),
                                            of_the(all("each", false)),
                                            most("most"),
                                            of_the(most("most")),
                                            some("a", false),
                                            some("any", false),
                                            some("any", true),
                                            some("some", true),
                                            of_the(some("any", true)),
                                            of_the(some("some", true)),
                                            none("no", false),
                                            none("no", true),
                                            of_the(none("none", false)),
                                            counted("one", false, 1, 1),
                                            counted("two", true, 2, 2),
                                            counted("exactly two", true, 2, 2),
                                            counted("at least two", true, 2, 1000),
                                            counted("at most two", true, 0, 2),
                                            counted("more than one", false, 2, 1000),
                                            counted("more than two", true, 3, 1000),
                                            counted("fewer than two", true, 0, 1),
                                            counted("several", true, 2, 1000),
                                            of_the(counted("one", false, 1, 1)),
                                            of_the(counted("two", true, 2, 2)),
                                            of_the(counted("at least two", true, 2, 1000)),
                                            of_the(counted("exactly one", false, 1, 1))};
  auto both = all("both", true);
  both.needs = [](auto& n) { return Presuppositions{exactly_two(n.is)}; };
  auto neither = none("neither", false);
  neither.needs = both.needs;
  auto the_two = all("the two", true);
  the_two.needs = both.needs;
  auto all_quantifiers = quantifiers;
  for (auto& x : {both, neither, the_two})
    all_quantifiers.push_back(x);
  for (auto& n : nouns())
    for (auto& p : scopes_of_several())
      for (auto& q : all_quantifiers) {
        const std::string copula = q.is_plural ? "are" : "is";
        const std::string rest = q.is_plural ? " <Q> <Ns> <Ps>" : " <Q> <N> <P>";
        const bool is_of = q.before.ends_with("of the");
        const auto form = is_of ? replaced(rest, "<N>", "<Ns>") : rest;
        add_quantified(Kind::whether, (q.is_plural ? "Are" : "Is") + form + '?', q, n, p);
        auto noun_words = q.is_plural || is_of ? " <Ns> " : " <N> ";
        auto scope_words = q.is_plural ? " <Ps>" : " <P>";
        if (q.before != "any" && q.before != "any of the") {
          add_quantified(Kind::statement, "<Q>" + (noun_words + copula) + scope_words + '.', q, n,
                         p);
          add_quantified(Kind::whether, "<Q>" + (noun_words + copula) + scope_words + ", right?", q,
                         n, p);
        }
        if (!p.is_plain)
          continue;
        const bool is_downward = q.before.starts_with("no") || q.before.starts_with("neither") ||
                                 q.before.starts_with("at most") || q.before.starts_with("fewer");
        if (!is_downward)
          add_quantified(Kind::whether, (q.is_plural ? "Aren't" : "Isn't") + form + '?', q, n, p);
        if (q.before.starts_with("some") || q.before == "two" || q.before == "most" ||
            q.before == "at least two" || q.before == "two of the" || q.before == "one of the") {
          const Scope otherwise{
            "not " + p.singular, "not " + p.plural, no_such(p).is, p.needs, p.landmark, false};
          add_quantified(Kind::whether,
                         (q.is_plural ? "Are" : "Is") + replaced(form, "<P", "(not) <P") + '?', q,
                         n, otherwise);
          add_quantified(Kind::statement,
                         "<Q>" + (noun_words + copula) + " (not)" + scope_words + '.', q, n,
                         otherwise);
        }
      }
}

void GridMaker::several_subjects() {
  for (auto& n : nouns())
    for (auto& p : scopes_of_several()) {
      const Claim only = [n, p](auto& world) {
        return std::min(is_from_to(number_of(world, all_of({n.is, p.is})), 1, 1000),
                        is_from_to(number_of(world, all_of({is_not(n.is), p.is})), 0, 0));
      };
      add(Kind::whether, "Are only <Ns> <Ps>?", fill("Are only <Ns> <Ps>?", n, &p), p.needs, only);
      if (p.is_plain)
        add(Kind::whether, "Is there a <N> on the table that is <P>?",
            fill("Is there a <N> on the table that is <P>?", n, &p), p.needs,
            there_is(all_of({n.is, p.is})));
      add(Kind::statement, "Only <Ns> are <Ps>.", fill("Only <Ns> are <Ps>.", n, &p), p.needs,
          only);
      auto every = all("all", true);
      for (const auto* form : {"Not all <Ns> are <Ps>.", "Not every <N> is <P>."})
        add(Kind::statement, form, fill(form, n, &p), together({at_least_one(n.is)}, p.needs),
            [n, p, every](auto& world) {
              return opposite(every.holds(world, domain(world, n, p), p.is));
            });
      for (auto x = sentences.end() - 2; x != sentences.end(); ++x)
        x->is_odd = [n, p](auto& world) { return is_about_itself(world, n, p); };
    }
  for (auto& a : nouns())
    for (auto& b : nouns()) {
      if (a.singular == b.singular)
        continue;
      const auto is_like = [&](const std::string& quality) -> Claim {
        return [=](auto& world) {
          auto result = Verdict::no;
          for (auto& x : world)
            for (auto& y : world)
              result =
                std::max(result, std::min({a.is(world, x), b.is(world, y),
                                           quality == "colour" ? is_same(x.colour, y.colour)
                                                               : is_same(x.shape, y.shape)}));
          return result;
        };
      };
      for (const std::string quality : {"colour", "shape"})
        for (const std::string form : {"Are the <N> and the <M> the same colour?",
                                       "Does the <N> have the same colour as the <M>?",
                                       "Do the <N> and the <M> have the same colour?"}) {
          add(Kind::whether, form,
              replaced(replaced(fill(form, a), "<M>", b.singular), "colour", quality),
              {exactly_one(a.is), exactly_one(b.is)}, is_like(quality));
          odd_if_any(all_of({a.is, b.is}));
        }
      for (auto& p : {adjective("red"), adjective("large"), a_kind("cube"),
                      related_to_the("left of", left, "cylinder"),
                      related_to("near", near, some("a", false), "ball")}) {
        const auto ask = [&](Kind kind, const std::string& form, const Claim& claim) {
          add(kind, form, replaced(fill(form, a, &p), "<M>", b.singular),
              together({exactly_one(a.is), exactly_one(b.is)}, p.needs), claim);
          odd_if_any(any_of({all_of({a.is, p.landmark}), all_of({b.is, p.landmark})}));
        };
        auto first = there_is(all_of({a.is, p.is}));
        auto second = there_is(all_of({b.is, p.is}));
        ask(Kind::whether, "Are the <N> and the <M> <Ps>?", both_so(first, second));
        ask(Kind::whether, "Are both the <N> and the <M> <Ps>?", both_so(first, second));
        ask(Kind::whether, "Is the <N> <P> and the <M> small?",
            both_so(first, there_is(all_of({b.is, has_size("small")}))));
        ask(Kind::statement, "The <N> is <P> and the <M> small.",
            both_so(first, there_is(all_of({b.is, has_size("small")}))));
        ask(Kind::whether, "Is neither the <N> nor the <M> <P>?",
            both_so(not_so(first), not_so(second)));
        ask(Kind::statement, "The <N> and the <M> are <Ps>.", both_so(first, second));
        ask(Kind::statement, "Neither the <N> nor the <M> is <P>.",
            both_so(not_so(first), not_so(second)));
      }
    }
}

// -- statements of existence

void GridMaker::statements_of_existence() {
  auto of_things = nouns();
  for (auto& n : nouns())
    for (auto& place : places())
      of_things.push_back(with_place(n, place));
  for (auto& n : of_things) {
    const auto say = [&](const std::string& form, std::size_t least, std::size_t most = 1000) {
      add(Kind::statement, form, fill(form, n), n.needs, there_is(n.is, least, most), n.is);
    };
    say("There is a <N>.", 1);
    say("There's a <N>.", 1);
    say("There is no <N>.", 0, 0);
    say("There is not a <N>.", 0, 0);
    say("There isn't any <N>.", 0, 0);
    say("There are <Ns>.", 1);
    say("There are some <Ns>.", 1);
    say("There are no <Ns>.", 0, 0);
    say("There aren't any <Ns>.", 0, 0);
    say("There is one <N>.", 1, 1);
    say("There is only one <N>.", 1, 1);
    say("There are two <Ns>.", 2, 2);
    say("There are exactly two <Ns>.", 2, 2);
    say("There are at least two <Ns>.", 2);
    say("There are at most two <Ns>.", 0, 2);
    say("There are more than two <Ns>.", 3);
    say("I see a <N>.", 1);
    say("You see two <Ns>.", 2, 2);
  }
  auto things = noun("thing");
  for (auto& p : scopes_of_several())
    for (auto& q : {some("something", false), none("nothing", false), all("everything", false)})
      add_quantified(Kind::statement, "<Q> is <P>.", q, things, p);
}

} // namespace castor::communication::test
