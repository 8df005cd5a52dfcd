#pragma once

#include "castor/wm/filters/predicate.hpp"
#include "castor/wm/filters/predicate_tree.hpp"
#include "castor/wm/values/descriptor_of.hpp"
#include "castor/wm/values/field_name.hpp"
#include "castor/wm/values/object_access.hpp"

#include <array>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

/// Predicates from members of C++ types; type errors are compile-time errors.
///
///     field(&SceneObject::confidence) > 0.8 && field(&SceneObject::label) == "box"
///     field(&SceneObject::pose, &Pose::position, &Point::x) < 1
///     distance(field(&SceneObject::position), Point{1, 2, 0}) < 0.5
///     !field(&SceneObject::is_held) || has(field(&SceneObject::pose))
namespace castor {

/// A predicate over entries of type T.
template <ReflectedRecord T>
class PredicateOf : public Predicate {
public:
  using Root = T;

  explicit PredicateOf(Predicate x) : Predicate(std::move(x)) {}

  /// Throws PredicateError, and FieldError if the predicate does not fit T.
  static PredicateOf parse(std::string_view text) {
    PredicateOf result{Predicate::parse(text)};
    result.check(*descriptor_of<T>());
    return result;
  }

  PredicateOf operator!() const { return PredicateOf{Predicate::operator!()}; }
};

template <ReflectedRecord T, class L>
struct Field;

template <ReflectedRecord T>
struct DistanceOf;

namespace detail {

template <class T>
struct Present {
  using Type = T;
};

template <class T>
struct Present<std::optional<T>> : Present<T> {};

template <class T>
inline constexpr bool is_operand = false;
template <class T, class L>
inline constexpr bool is_operand<Field<T, L>> = true;
template <class T>
inline constexpr bool is_operand<DistanceOf<T>> = true;

template <class T>
concept NumberType = std::is_arithmetic_v<T> && !std::same_as<T, bool> && !std::same_as<T, char> &&
                     !std::same_as<T, wchar_t> && !std::same_as<T, long double>;

/// Whether a field of one type can be compared with a value of another.
template <class Leaf, class V>
concept ComparableTypes = (NumberType<Leaf> && NumberType<V>) ||
                          (std::same_as<Leaf, bool> && std::same_as<V, bool>) ||
                          (std::same_as<Leaf, std::string> &&
                           std::convertible_to<const V&, std::string_view>) ||
                          (ReflectedEnum<Leaf> && std::same_as<Leaf, V>);

/// Whether entries of one of the two types are also of the other.
template <class A, class B>
concept RelatedRoots = std::is_base_of_v<A, B> || std::is_base_of_v<B, A>;

template <class A, class B>
using DerivedRoot = std::conditional_t<std::is_base_of_v<A, B>, B, A>;

template <class V>
FieldValue literal(const V& x) {
  if constexpr (ReflectedEnum<V>)
    return enumerator_value(x);
  else if constexpr (std::same_as<V, bool>)
    return x;
  else if constexpr (std::is_floating_point_v<V>)
    return static_cast<double>(x);
  else if constexpr (std::is_integral_v<V> && std::is_signed_v<V>)
    return static_cast<std::int64_t>(x);
  else if constexpr (std::is_integral_v<V>)
    return static_cast<std::uint64_t>(x);
  else
    return std::string{std::string_view{x}};
}

/// The other side of a comparison: a literal or another operand.
template <class V>
struct OtherSide {
  template <class Root>
  using RootWith = Root;
  using Type = V;
  static predicate::Operand operand(const V& x) { return literal(x); }
};

template <class V>
requires is_operand<V>
struct OtherSide<V> {
  template <class Root>
  using RootWith = DerivedRoot<Root, typename V::Root>;
  using Type = typename V::Leaf;
  static predicate::Operand operand(const V& x) { return x.operand(); }
};

template <class A, class B>
concept RelatedSides = !is_operand<B> || requires {
  requires RelatedRoots<typename A::Root, typename B::Root>;
};

template <class A, class B>
concept Comparable = is_operand<A> && RelatedSides<A, B> &&
  ComparableTypes<typename A::Leaf, typename OtherSide<B>::Type>;

/// Enumerators have no order.
template <class A, class B>
concept Ordered = Comparable<A, B> && !std::is_enum_v<typename A::Leaf>;

template <class A, class B>
auto compared(const A& a, Comparison op, const B& b) {
  using Root = typename OtherSide<B>::template RootWith<typename A::Root>;
  return PredicateOf<Root>{
    Predicate{predicate::condition(a.operand(), op, OtherSide<B>::operand(b))}};
}

/// Comparison operators of fields and distances; friends, so that overload resolution of other
/// types does not consider them.
template <class Self>
struct Comparisons {
  template <class Other>
  requires Comparable<Self, Other>
  friend auto operator==(const Self& a, const Other& b) {
    return compared(a, Comparison::equal, b);
  }

  template <class Other>
  requires Comparable<Self, Other>
  friend auto operator!=(const Self& a, const Other& b) {
    return compared(a, Comparison::not_equal, b);
  }

  template <class Other>
  requires Ordered<Self, Other>
  friend auto operator<(const Self& a, const Other& b) { return compared(a, Comparison::less, b); }

  template <class Other>
  requires Ordered<Self, Other>
  friend auto operator<=(const Self& a, const Other& b) {
    return compared(a, Comparison::less_equal, b);
  }

  template <class Other>
  requires Ordered<Self, Other>
  friend auto operator>(const Self& a, const Other& b) {
    return compared(a, Comparison::greater, b);
  }

  template <class Other>
  requires Ordered<Self, Other>
  friend auto operator>=(const Self& a, const Other& b) {
    return compared(a, Comparison::greater_equal, b);
  }
};

/// Whether a record, or one of its bases, has a number field of that name.
template <ReflectedRecord T>
constexpr bool has_number(std::string_view name) {
  using Base = typename decltype(reflection_of<T>())::BaseType;
  bool result = false;
  if constexpr (!std::is_void_v<Base>)
    result = has_number<Base>(name);
  auto look_at = [&]<class Member>(const ReflectedField<T, Member>& field) {
    if constexpr (std::is_arithmetic_v<Member> && !std::is_same_v<Member, bool>)
      result = result || field.name == name;
  };
  std::apply([&](const auto&... field) { (look_at(field), ...); }, reflection_of<T>().fields);
  return result;
}

/// Number of coordinates of a point type, by the rules of `Predicate`; 0 for other types.
template <class T>
struct Dimensions {
  static constexpr std::size_t value = 0;
};

template <ReflectedRecord T>
struct Dimensions<T> {
  static constexpr std::size_t value =
    has_number<T>("x") && has_number<T>("y") ? (has_number<T>("z") ? 3 : 2) : 0;
};

template <class T, std::size_t N>
struct Dimensions<std::array<T, N>> {
  static constexpr std::size_t value = NumberType<T> && (N == 2 || N == 3) ? N : 0;
};

template <class T>
concept PointType = Dimensions<T>::value >
0;

template <class A, class B>
concept SameDimensions =
  PointType<A> && PointType<B> && Dimensions<A>::value == Dimensions<B>::value;

template <PointType T>
predicate::Point point_literal(const T& p) {
  if constexpr (ReflectedRecord<T>) {
    predicate::Point result{static_cast<double>(p.x), static_cast<double>(p.y)};
    if constexpr (Dimensions<T>::value == 3)
      result.push_back(static_cast<double>(p.z));
    return result;
  } else {
    return {p.begin(), p.end()};
  }
}

/// A predicate over a type, or one of its truth-value fields.
template <class T>
concept PredicateExpression = requires(const T& x) {
  typename T::Root;
  static_cast<PredicateOf<typename T::Root>>(x);
};

template <PredicateExpression X>
PredicateOf<typename X::Root> as_predicate(const X& x) {
  return static_cast<PredicateOf<typename X::Root>>(x);
}

} // namespace detail

/// A field of `T`, or of a record in it, whose type (without optionals) is `L`.
template <ReflectedRecord T, class L>
struct Field : detail::Comparisons<Field<T, L>> {
  using Root = T;
  using Leaf = L;

  explicit Field(std::string path_of_names) : path(std::move(path_of_names)) {}

  std::string path;

  predicate::Operand operand() const { return predicate::Path{path}; }

  /// Predicate that a truth-value field is true.
  operator PredicateOf<T>() const requires std::same_as<L, bool> { return *this == true; }
};

/// The distance between two points, at least one of which is a field.
template <ReflectedRecord T>
struct DistanceOf : detail::Comparisons<DistanceOf<T>> {
  using Root = T;
  using Leaf = double;

  explicit DistanceOf(predicate::Distance x) : points(std::move(x)) {}

  predicate::Distance points;

  predicate::Operand operand() const { return points; }
};

/// A member, or a member of a member: `field(&Box::pose, &Pose::heading)`. Throws FieldError if a
/// member was left out of its type's declaration.
template <ReflectedRecord Owner, class Member>
Field<Owner, typename detail::Present<Member>::Type> field(Member Owner::*member) {
  return Field<Owner, typename detail::Present<Member>::Type>{std::string{field_name(member)}};
}

template <ReflectedRecord Owner, class Member, ReflectedRecord Next, class Inner, class... Rest>
requires FieldOwner<Next, typename detail::Present<Member>::Type>
auto field(Member Owner::*member, Inner Next::*inner, Rest... rest) {
  auto below = field(inner, rest...);
  return Field<Owner, typename decltype(below)::Leaf>{std::string{field_name(member)} + '.' +
                                                      below.path};
}

/// Distance from a field to a point.
template <class T, class L, class P>
requires detail::SameDimensions<L, P> DistanceOf<T> distance(const Field<T, L>& from, const P& to) {
  return DistanceOf<T>{predicate::distance(predicate::Path{from.path}, detail::point_literal(to))};
}

/// Distance between two fields.
template <class T, class L, class U, class M>
requires detail::SameDimensions<L, M> && detail::RelatedRoots<T, U>
  DistanceOf<detail::DerivedRoot<T, U>> distance(const Field<T, L>& from, const Field<U, M>& to) {
  return DistanceOf<detail::DerivedRoot<T, U>>{
    predicate::distance(predicate::Path{from.path}, predicate::Path{to.path})};
}

/// Predicate that neither the field nor an optional on the way to it is empty.
template <class T, class L>
PredicateOf<T> has(const Field<T, L>& x) {
  return PredicateOf<T>{Predicate{predicate::Node{predicate::Presence{{x.path}}}}};
}

template <detail::PredicateExpression A, detail::PredicateExpression B>
requires detail::RelatedRoots<typename A::Root, typename B::Root>
auto operator&&(const A& a, const B& b) {
  const Predicate& x = detail::as_predicate(a);
  return PredicateOf<detail::DerivedRoot<typename A::Root, typename B::Root>>{
    x && static_cast<const Predicate&>(detail::as_predicate(b))};
}

template <detail::PredicateExpression A, detail::PredicateExpression B>
requires detail::RelatedRoots<typename A::Root, typename B::Root>
auto operator||(const A& a, const B& b) {
  const Predicate& x = detail::as_predicate(a);
  return PredicateOf<detail::DerivedRoot<typename A::Root, typename B::Root>>{
    x || static_cast<const Predicate&>(detail::as_predicate(b))};
}

// Without these, the operators of Predicate would take predicates over unrelated types.
template <detail::PredicateExpression A, detail::PredicateExpression B>
requires(!detail::RelatedRoots<typename A::Root, typename B::Root>) void
operator&&(const A& a, const B& b) = delete;

template <detail::PredicateExpression A, detail::PredicateExpression B>
requires(!detail::RelatedRoots<typename A::Root, typename B::Root>) void
operator||(const A& a, const B& b) = delete;

template <class T>
PredicateOf<T> operator!(const Field<T, bool>& x) {
  return !detail::as_predicate(x);
}

} // namespace castor
