#include "castor/communication/parsing/hybrid_logic.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

/// Deeper nesting than any utterance has.
constexpr int max_depth = 100;

class FormulaReader {
public:
  explicit FormulaReader(std::string_view text) : text_(text) {
    // nop
  }

  LogicalForm read() {
    do {
      expect('@');
      const auto name = read_name();
      if (form_.root.empty())
        form_.root = name;
      const auto nominal = read_sort(name);
      if (accept('(')) {
        read_conjunction(nominal, 0);
        expect(')');
      }
    } while (accept('&'));
    skip_blanks();
    if (at_ < text_.size())
      fail("expected nothing more");
    return std::move(form_);
  }

private:
  [[noreturn]] void fail(const std::string& message) { throw HybridLogicError(message, at_); }

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
      ++at_;
  }

  bool accept(char c) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != c)
      return false;
    ++at_;
    return true;
  }

  void expect(char c) {
    if (!accept(c))
      fail(std::string("expected \"") + c + "\"");
  }

  std::string read_name() {
    skip_blanks();
    const auto begin = at_;
    constexpr std::string_view ends = "@:()^<>&";
    while (at_ < text_.size() && ends.find(text_[at_]) == std::string_view::npos &&
           std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
      ++at_;
    if (begin == at_)
      fail("expected a name");
    return std::string(text_.substr(begin, at_ - begin));
  }

  /// The place of the nominal in the form; nominals move as the form grows.
  std::size_t read_sort(const std::string& name) {
    const auto place =
      std::find_if(form_.nominals.begin(), form_.nominals.end(),
                   [&name](const Nominal& nominal) { return nominal.name == name; });
    const auto index = static_cast<std::size_t>(place - form_.nominals.begin());
    if (place == form_.nominals.end())
      form_.nominals.push_back({name, {}, {}, {}, {}});
    if (accept(':')) {
      auto sort = read_name();
      auto& known = form_.nominals[index].sort;
      if (!known.empty() && known != sort)
        fail(name + " is of the sort " + known + " already");
      known = std::move(sort);
    }
    return index;
  }

  void read_conjunction(std::size_t nominal, int depth) {
    if (depth > max_depth)
      fail("this is nested too deeply");
    do
      read_conjunct(nominal, depth);
    while (accept('^'));
  }

  void read_conjunct(std::size_t nominal, int depth) {
    if (!accept('<')) {
      auto proposition = read_name();
      auto& known = form_.nominals[nominal].proposition;
      if (!known.empty())
        fail(form_.nominals[nominal].name + " has the proposition " + known + " already");
      known = std::move(proposition);
      return;
    }
    auto name = read_name();
    expect('>');
    if (!accept('(')) {
      form_.nominals[nominal].features.push_back({std::move(name), read_name()});
      return;
    }
    const auto dependent_name = read_name();
    form_.nominals[nominal].relations.push_back({std::move(name), dependent_name});
    const auto dependent_index = read_sort(dependent_name);
    if (accept('^'))
      read_conjunction(dependent_index, depth + 1);
    expect(')');
  }

  std::string_view text_;
  std::size_t at_ = 0;
  LogicalForm form_;
};

class FormulaWriter {
public:
  explicit FormulaWriter(const LogicalForm& form) : form_(form) {
    // nop
  }

  std::string write() {
    std::string text;
    if (const auto* root = find_nominal(form_, form_.root))
      text = write_formula(*root);
    for (const auto& nominal : form_.nominals)
      if (!written_.contains(nominal.name))
        text += (text.empty() ? "" : " & ") + write_formula(nominal);
    return text;
  }

private:
  std::string write_formula(const Nominal& nominal) {
    const auto inside = write_conjuncts(nominal);
    return "@" + write_name(nominal) + (inside.empty() ? "" : "(" + inside + ")");
  }

  static std::string write_name(const Nominal& nominal) {
    return nominal.name + (nominal.sort.empty() ? "" : ":" + nominal.sort);
  }

  std::string write_conjuncts(const Nominal& nominal) {
    written_.insert(nominal.name);
    std::string text;
    const auto append = [&text](const std::string& conjunct) {
      text += (text.empty() ? "" : " ^ ") + conjunct;
    };
    if (!nominal.proposition.empty())
      append(nominal.proposition);
    for (const auto& feature : nominal.features)
      append("<" + feature.name + ">" + feature.value);
    for (const auto& relation : nominal.relations) {
      const auto* dependent = find_nominal(form_, relation.dependent);
      std::string inside = relation.dependent;
      if (dependent != nullptr && !written_.contains(dependent->name)) {
        inside = write_name(*dependent);
        if (const auto conjuncts = write_conjuncts(*dependent); !conjuncts.empty())
          inside += " ^ " + conjuncts;
      }
      append("<" + relation.mode + ">(" + inside + ")");
    }
    return text;
  }

  const LogicalForm& form_;
  std::set<std::string_view> written_;
};

/// Tries to map the nominals of one form to those of the other.
class Correspondence {
public:
  Correspondence(const LogicalForm& a, const LogicalForm& b) : a_(a), b_(b) {
    // nop
  }

  bool match(std::string_view name_a, std::string_view name_b) {
    const auto known = map_.find(name_a);
    if (known != map_.end())
      return known->second == name_b;
    if (!used_.insert(name_b).second)
      return false;
    map_.emplace(name_a, name_b);
    const auto* x = find_nominal(a_, name_a);
    const auto* y = find_nominal(b_, name_b);
    if (x == nullptr || y == nullptr)
      return x == y;
    return x->sort == y->sort && x->proposition == y->proposition && same_features(*x, *y) &&
           same_relations(*x, *y);
  }

  std::size_t size() const { return map_.size(); }

private:
  static bool same_features(const Nominal& x, const Nominal& y) {
    return std::is_permutation(x.features.begin(), x.features.end(), y.features.begin(),
                               y.features.end());
  }

  bool same_relations(const Nominal& x, const Nominal& y) {
    if (x.relations.size() != y.relations.size())
      return false;
    std::vector<bool> taken(y.relations.size(), false);
    return std::all_of(x.relations.begin(), x.relations.end(), [&](const NominalRelation& from) {
      for (std::size_t i = 0; i < taken.size(); ++i) {
        if (taken[i] || y.relations[i].mode != from.mode)
          continue;
        auto attempt = *this;
        if (!attempt.match(from.dependent, y.relations[i].dependent))
          continue;
        map_ = std::move(attempt.map_);
        used_ = std::move(attempt.used_);
        taken[i] = true;
        return true;
      }
      return false;
    });
  }

  const LogicalForm& a_;
  const LogicalForm& b_;
  std::map<std::string_view, std::string_view> map_;
  std::set<std::string_view> used_;
};

} // namespace

HybridLogicError::HybridLogicError(const std::string& message, std::size_t offset)
  : std::runtime_error(printable(message)), offset_(offset) {
  // nop
}

LogicalForm parse_logical_form(std::string_view text) {
  return FormulaReader(text).read();
}

std::string to_string(const LogicalForm& form) {
  return FormulaWriter(form).write();
}

const Nominal* find_nominal(const LogicalForm& form, std::string_view name) {
  const auto place = std::find_if(form.nominals.begin(), form.nominals.end(),
                                  [name](const Nominal& nominal) { return nominal.name == name; });
  return place == form.nominals.end() ? nullptr : &*place;
}

Nominal* find_nominal(LogicalForm& form, std::string_view name) {
  return const_cast<Nominal*>(find_nominal(std::as_const(form), name));
}

const Nominal* dependent(const LogicalForm& form, const Nominal& nominal, std::string_view mode) {
  for (const auto& relation : nominal.relations)
    if (relation.mode == mode)
      return find_nominal(form, relation.dependent);
  return nullptr;
}

std::string_view feature(const Nominal& nominal, std::string_view name) {
  for (const auto& feature : nominal.features)
    if (feature.name == name)
      return feature.value;
  return {};
}

bool equivalent(const LogicalForm& a, const LogicalForm& b) {
  Correspondence correspondence(a, b);
  return a.nominals.size() == b.nominals.size() && correspondence.match(a.root, b.root) &&
         correspondence.size() == a.nominals.size();
}

bool is_negated(const Nominal& nominal) {
  return feature(nominal, "Polarity") == "neg";
}

bool is_plural(const Nominal& nominal) {
  return feature(nominal, "Number") == "pl";
}

} // namespace castor::communication
