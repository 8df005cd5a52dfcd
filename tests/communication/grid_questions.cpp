#include "castor/tests/communication/grid_maker.hpp"

#include <utility>

namespace castor::communication::test {

using namespace oracle;

void GridMaker::open_questions() {
  things_asked_for();
  numbers_asked_for();
  qualities_asked_for();
}

void GridMaker::things_asked_for() {
  const auto ask = [&](const std::string& form, const std::string& text, Presuppositions needs,
                       Predicate asked) {
    add(Kind::which, form, text, std::move(needs), {}, std::move(asked));
  };
  for (auto& n : nouns())
    for (auto& p : scopes_of_several()) {
      auto so = all_of({n.is, p.is});
      for (const auto* form : {"Which <Ns> are <Ps>?", "Which <N> is <P>?", "What <Ns> are <Ps>?"})
        ask(form, fill(form, n, &p), p.needs, so);
      ask("What <Ns> do you see that are <Ps>?", fill("What <Ns> do you see that are <Ps>?", n, &p),
          p.needs, so);
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

void GridMaker::numbers_asked_for() {
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

void GridMaker::qualities_asked_for() {
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

} // namespace castor::communication::test
