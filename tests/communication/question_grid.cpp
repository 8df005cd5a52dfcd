#include "castor/tests/communication/grid_maker.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace castor::communication::test {

using namespace oracle;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// -- claims

Claim there_is(const Predicate& is, std::size_t least, std::size_t most) {
  return [=](auto& world) { return is_from_to(number_of(world, is), least, most); };
}

Claim not_so(const Claim& x) {
  return [x](auto& world) { return opposite(x(world)); };
}

Claim both_so(const Claim& a, const Claim& b) {
  return [=](auto& world) { return std::min(a(world), b(world)); };
}

Claim either_so(const Claim& a, const Claim& b) {
  return [=](auto& world) { return std::max(a(world), b(world)); };
}

// -- filling in

void GridMaker::add(Kind kind, const std::string& form, const std::string& text,
                    Presuppositions needs, Claim claim, Predicate asked) {
  sentences.push_back(
    {form, text, kind, std::move(needs), std::move(claim), std::move(asked), {}, {}, {}});
  sentences.back().text.front() =
    static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
}

std::string GridMaker::fill(std::string form, const NounPhrase& n, const Scope* p) {
  if (p != nullptr) {
    form = replaced(form, "<Ps>", p->plural);
    form = replaced(form, "<P>", p->singular);
  }
  form = replaced(form, "<Ns>", n.plural);
  return replaced(form, "<N>", n.singular);
}

void GridMaker::add_quantified(Kind kind, const std::string& form, const Quantifier& q,
                               const NounPhrase& n, const Scope& p) {
  auto label = replaced(form, "<Q>", q.before);
  add(kind, label, replaced(fill(label, n, &p), "(not) ", ""),
      together(q.needs(n), together(n.needs, p.needs)),
      [q, n, p](auto& world) { return q.holds(world, domain(world, n, p), p.is); });
  // Of all there may be none but the one that the others are compared with.
  sentences.back().is_odd = [n, p](auto& world) { return is_about_itself(world, n, p); };
}

bool GridMaker::is_about_itself(const World& world, const NounPhrase& n, const Scope& p) {
  return number_of(world, all_of({n.is, p.landmark})).most > 0 &&
         number_of(world, all_of({n.is, is_not(p.landmark)})).least == 0;
}

void GridMaker::odd_if_any(const Predicate& is) {
  sentences.back().is_odd = [is](auto& world) { return number_of(world, is).most > 0; };
}

Predicate GridMaker::domain(const World& world, const NounPhrase& n, const Scope& p) {
  auto others = all_of({n.is, is_not(p.landmark)});
  return number_of(world, others).most == 0 ? n.is : others;
}

std::vector<GridSentence> question_grid() {
  GridMaker grid;
  grid.claims();
  grid.open_questions();
  grid.statements_of_existence();
  return std::move(grid.sentences);
}

} // namespace castor::communication::test
