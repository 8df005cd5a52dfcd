#include "castor/tests/communication/question_grid.hpp"

#include "castor/tests/communication/grid_fillers.hpp"

#include <cctype>
#include <utility>

namespace castor::communication::test {

using namespace oracle;

namespace {

using Kind = GridSentence::Kind;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

class Grid {
public:
  std::vector<GridSentence> sentences;

  void make() {
    existence();
    existence_of_several();
    indefinite_pronouns();
    definite_subjects();
    quantified_subjects();
    several_subjects();
    things_asked_for();
    numbers_asked_for();
    qualities_asked_for();
    statements();
  }

private:
  void add(Kind kind, const std::string& form, const std::string& text, Presuppositions needs,
           Claim claim, Predicate asked = {}) {
    sentences.push_back(
      {form, text, kind, std::move(needs), std::move(claim), std::move(asked), {}, {}, {}});
    sentences.back().text.front() =
      static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  }

  /// In forms, N and Ns are nouns, P is what is said of one thing, Ps of several.
  static std::string fill(std::string form, const NounPhrase& n, const Scope* p = nullptr) {
    if (p != nullptr) {
      form = replaced(form, "<Ps>", p->plural);
      form = replaced(form, "<P>", p->singular);
    }
    form = replaced(form, "<Ns>", n.plural);
    return replaced(form, "<N>", n.singular);
  }

  /// The quantifier's words are <Q>.
  void add_quantified(Kind kind, const std::string& form, const Quantifier& q, const NounPhrase& n,
                      const Scope& p) {
    auto label = replaced(form, "<Q>", q.before);
    add(kind, label, replaced(fill(label, n, &p), "(not) ", ""),
        together(q.needs(n), together(n.needs, p.needs)),
        [q, n, p](auto& world) { return q.holds(world, domain(world, n, p), p.is); });
    // Of all there may be none but the one that the others are compared with.
    sentences.back().is_odd = [n, p](auto& world) { return is_about_itself(world, n, p); };
  }

  static bool is_about_itself(const World& world, const NounPhrase& n, const Scope& p) {
    return number_of(world, all_of({n.is, p.landmark})).most > 0 &&
           number_of(world, all_of({n.is, is_not(p.landmark)})).least == 0;
  }

  void odd_if_any(const Predicate& is) {
    sentences.back().is_odd = [is](auto& world) { return number_of(world, is).most > 0; };
  }

  /// Nothing is said of landmarks, if there is something else.
  static Predicate domain(const World& world, const NounPhrase& n, const Scope& p) {
    auto others = all_of({n.is, is_not(p.landmark)});
    return number_of(world, others).most == 0 ? n.is : others;
  }

  static Claim there_is(const Predicate& is, std::size_t least = 1, std::size_t most = 1000) {
    return [=](auto& world) { return is_from_to(number_of(world, is), least, most); };
  }

  static Claim not_so(const Claim& x) {
    return [x](auto& world) { return opposite(x(world)); };
  }

  static Claim both_so(const Claim& a, const Claim& b) {
    return [=](auto& world) { return std::min(a(world), b(world)); };
  }

  static Claim either_so(const Claim& a, const Claim& b) {
    return [=](auto& world) { return std::max(a(world), b(world)); };
  }

  void existence();
  void existence_of_several();
  void indefinite_pronouns();
  void definite_subjects();
  void quantified_subjects();
  void several_subjects();
  void things_asked_for();
  void numbers_asked_for();
  void qualities_asked_for();
  void statements();
};

// -- existence

void Grid::existence() {
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

void Grid::existence_of_several() {
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

void Grid::indefinite_pronouns() {
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

void Grid::definite_subjects() {
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

void Grid::quantified_subjects() {
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

void Grid::several_subjects() {
  for (auto& n : nouns())
    for (auto& p : scopes_of_several()) {
      const Claim only = [n, p](auto& world) {
        return std::min(is_from_to(number_of(world, all_of({n.is, p.is})), 1, 1000),
                        is_from_to(number_of(world, all_of({is_not(n.is), p.is})), 0, 0));
      };
      add(Kind::whether, "Are only <Ns> <Ps>?", fill("Are only <Ns> <Ps>?", n, &p), p.needs, only);
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
        ask(Kind::whether, "Is neither the <N> nor the <M> <P>?",
            both_so(not_so(first), not_so(second)));
        ask(Kind::statement, "The <N> and the <M> are <Ps>.", both_so(first, second));
        ask(Kind::statement, "Neither the <N> nor the <M> is <P>.",
            both_so(not_so(first), not_so(second)));
      }
    }
}

// -- what is asked for

void Grid::things_asked_for() {
  const auto ask = [&](const std::string& form, const std::string& text, Presuppositions needs,
                       Predicate asked) {
    add(Kind::which, form, text, std::move(needs), {}, std::move(asked));
  };
  for (auto& n : nouns())
    for (auto& p : scopes_of_several()) {
      auto so = all_of({n.is, p.is});
      for (const auto* form : {"Which <Ns> are <Ps>?", "Which <N> is <P>?", "What <Ns> are <Ps>?"})
        ask(form, fill(form, n, &p), p.needs, so);
      ask("Which of the <Ns> are <Ps>?", fill("Which of the <Ns> are <Ps>?", n, &p),
          together({at_least_one(n.is)}, p.needs), so);
      if (!p.is_plain)
        continue;
      auto not_so = all_of({n.is, no_such(p).is});
      for (const auto* form : {"Which <Ns> are not <Ps>?", "Which <N> is not <P>?"})
        ask(form, fill(form, n, &p), p.needs, not_so);
      ask("Which of the <Ns> are not <Ps>?", fill("Which of the <Ns> are not <Ps>?", n, &p),
          together({at_least_one(n.is)}, p.needs), not_so);
    }
  for (auto& p : scopes_of_several()) {
    if (p.singular.starts_with("a ") || p.singular.starts_with("not a "))
      continue;
    ask("What is <P>?", "What is " + p.singular + '?', p.needs, p.is);
    ask("Which things are <Ps>?", "Which things are " + p.plural + '?', p.needs, p.is);
  }
  struct Order {
    const char* word;
    Before before;
  };
  for (auto& n : nouns()) {
    for (auto& [word, before] :
         {Order{"largest", by_size(true)}, Order{"smallest", by_size(false)},
          Order{"leftmost", from_the_left()}, Order{"rightmost", from_the_right()}}) {
      auto most = in_order(n.is, before);
      for (const std::string form : {"Which is the largest <N>?", "What is the largest <N>?"})
        ask(form, replaced(fill(form, n), "largest", word), {exactly_one(most)}, most);
      // Of two that are as large as one another, either may be.
      for (const std::string form : {"Which <N> is the largest?", "Which <N> is largest?"})
        ask(form, replaced(fill(form, n), "largest", word), {}, most);
    }
    for (auto& to : nouns()) {
      if (to.singular == "thing")
        continue;
      auto most = in_order(all_of({n.is, is_not(to.is)}), nearer_to(to));
      for (const std::string form :
           {"Which <N> is closest to the <M>?", "Which <N> is the closest to the <M>?"})
        ask(form, replaced(fill(form, n), "<M>", to.singular), {exactly_one(to.is)}, most);
      ask("What is the closest <N> to the <M>?",
          "What is the closest " + n.singular + " to the " + to.singular + '?',
          {exactly_one(to.is), exactly_one(most)}, most);
    }
    for (std::size_t rank = 1; rank <= 3; ++rank) {
      const std::string word = rank == 1 ? "first" : rank == 2 ? "second" : "third";
      auto from_left = in_order(n.is, from_the_left(), rank);
      auto from_right = in_order(n.is, from_the_right(), rank);
      for (const std::string form :
           {"Which is the second <N> from the left?", "What is the second <N> from the left?"}) {
        auto text = replaced(fill(form, n), "second", word);
        ask(form, text, {exactly_one(from_left)}, from_left);
        ask(form, replaced(text, "left", "right"), {exactly_one(from_right)}, from_right);
      }
      const std::string form = "Which <N> is the second from the left?";
      ask(form, replaced(fill(form, n), "second", word), {}, from_left);
    }
  }
}

void Grid::numbers_asked_for() {
  const auto ask = [&](const std::string& form, const std::string& text, Presuppositions needs,
                       Predicate asked) {
    add(Kind::how_many, form, text, std::move(needs), {}, std::move(asked));
  };
  for (auto& n : nouns()) {
    for (const auto* form : {"How many <Ns> are there?", "How many <Ns> do you see?",
                             "How many <Ns> are on the table?", "Count the <Ns>."})
      ask(form, fill(form, n),
          std::string{form}.starts_with("Count") ? Presuppositions{at_least_one(n.is)}
                                                 : Presuppositions{},
          n.is);
    for (auto& p : places()) {
      auto here = with_place(n, p);
      for (const auto* form : {"How many <Ns> are there?", "How many <Ns> do you see?"})
        ask(form, fill(form, here), here.needs, here.is);
      ask("How many <Ns> are there <P>?", fill("How many <Ns> are there <P>?", n, &p), p.needs,
          here.is);
    }
    for (auto& p : scopes_of_several()) {
      ask("How many <Ns> are <Ps>?", fill("How many <Ns> are <Ps>?", n, &p), p.needs,
          all_of({n.is, p.is}));
      ask("How many of the <Ns> are <Ps>?", fill("How many of the <Ns> are <Ps>?", n, &p),
          together({at_least_one(n.is)}, p.needs), all_of({n.is, p.is}));
      if (!p.is_plain)
        continue;
      ask("How many <Ns> are not <Ps>?", fill("How many <Ns> are not <Ps>?", n, &p), p.needs,
          all_of({n.is, no_such(p).is}));
      ask("How many of the <Ns> are not <Ps>?", fill("How many of the <Ns> are not <Ps>?", n, &p),
          together({at_least_one(n.is)}, p.needs), all_of({n.is, no_such(p).is}));
    }
  }
}

void Grid::qualities_asked_for() {
  auto things = nouns();
  for (auto& n : nouns())
    for (auto& place : places())
      if (place.singular.find("every") == std::string::npos)
        things.push_back(with_place(n, place));
  for (auto& n : nouns()) {
    things.push_back({"largest " + n.singular, "", in_order(n.is, by_size(true))});
    things.push_back({"leftmost " + n.singular, "", in_order(n.is, from_the_left())});
    things.push_back({n.singular + " that is the largest", "", in_order(n.is, by_size(true))});
    if (n.singular.find("red") == std::string::npos &&
        n.singular.find("blue") == std::string::npos) {
      things.push_back({"smallest " + n.singular + " that is red", "",
                        in_order(all_of({n.is, has_colour("red")}), by_size(false))});
      things.push_back(that_is(n, adjective("red"), false));
    }
    things.push_back(that_is(n, adjective("large"), true));
  }
  for (auto& n : things)
    for (const std::string quality : {"colour", "shape", "size"})
      for (const std::string form : {"What colour is the <N>?", "What is the colour of the <N>?",
                                     "What colour does the <N> have?"}) {
        add(Kind::quality, form, replaced(fill(form, n), "colour", quality),
            together({exactly_one(n.is)}, n.needs), {}, n.is);
        sentences.back().quality = quality;
      }
  for (auto& n : nouns())
    for (auto& [first, second] : {std::pair{"red", "blue"}, std::pair{"blue", "green"},
                                  std::pair{"small", "large"}, std::pair{"cube", "ball"}}) {
      const std::string article = std::string{first} == "cube" ? "a " : "";
      add(Kind::choice, "Is the <N> <P> or <Q>?",
          "Is the " + n.singular + ' ' + article + first + " or " + article + second + '?',
          {exactly_one(n.is)}, {}, n.is);
      sentences.back().alternatives = {first, second};
    }
}

// -- statements of existence

void Grid::statements() {
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

} // namespace

std::vector<GridSentence> question_grid() {
  Grid grid;
  grid.make();
  return std::move(grid.sentences);
}

} // namespace castor::communication::test
