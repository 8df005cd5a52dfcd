#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// What is so on a table, worked out by brute force. It shares nothing with what it judges: neither
/// code nor constants, so it includes nothing of the product.
namespace castor::communication::test::oracle {

/// Something on a table, of which the colour or the shape may be unknown: empty.
struct Thing {
  std::string id;
  std::string colour;
  /// "cube", "ball", "cylinder", "pyramid".
  std::string shape;
  /// "small" or "large".
  std::string size;
  /// Metres.
  double extent = 0;
  /// To the right, metres.
  double x = 0;
  /// Away from the viewer, metres.
  double y = 0;
};

/// All things. Either everything is known of them, or what is said of them may be unknown.
using World = std::vector<Thing>;

/// In an order such that all of several is the least of them, and any the greatest.
enum class Verdict { no, unknown, yes };

Verdict verdict(bool x);
Verdict opposite(Verdict x);

/// What is said of a thing. Unknown where two measures are too close to say which is more, and by
/// what is not known of the thing.
using Predicate = std::function<Verdict(const World&, const Thing&)>;

/// What is said of the world.
using Claim = std::function<Verdict(const World&)>;

/// Whether there is what a phrase takes for granted.
enum class Presence {
  there,
  missing,
  several,
  /// Not known, or too close to say.
  unknown,
};
using Presupposition = std::function<Presence(const World&)>;

/// All that may be so, given what is not known of the things: a colour or a shape that nobody talks
/// about is among what they may have.
std::vector<World> completions(const std::vector<Thing>& scene);

// -- space and size

bool is_left_of(const Thing& a, const Thing& b);
bool is_behind(const Thing& a, const Thing& b);
bool is_near(const Thing& a, const Thing& b);
bool is_larger(const Thing& a, const Thing& b);

/// Whether two words are the same; an empty one may be any.
Verdict is_same(const std::string& a, const std::string& b);

// -- predicates

Predicate anything();
Predicate has_colour(const std::string& word);
Predicate has_shape(const std::string& word);
Predicate has_size(const std::string& word);
Predicate all_of(std::vector<Predicate> predicates);
Predicate any_of(std::vector<Predicate> predicates);
Predicate is_not(Predicate predicate);

// -- counting

/// How many things something is said of.
struct Number {
  std::size_t least = 0;
  std::size_t most = 0;
};

Number number_of(const World& world, const Predicate& what);

/// Whether there are from `least` to `most`.
Verdict is_from_to(const Number& x, std::size_t least, std::size_t most);

/// What comes before what, when things are put in an order.
using Before = std::function<bool(const World&, const Thing&, const Thing&)>;

/// Whether exactly `rank` - 1 others of a kind come before a thing; unknown where others are too
/// close to it.
Predicate in_order(Predicate kind, Before before, std::size_t rank = 1);

} // namespace castor::communication::test::oracle
