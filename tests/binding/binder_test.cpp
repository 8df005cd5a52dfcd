#include "castor/binding/binder.hpp"

#include "castor/tests/binding/proxies.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace castor::binding::test {

namespace {

using Kind = BinderStep::Kind;

const std::string proxy_id = "p";
const BindingProxy some_proxy;
const ProxyRef ref{&proxy_id, &some_proxy};

BindingUnion union_with(std::vector<std::string> ids) {
  BindingUnion result;
  result.proxy_ids = std::move(ids);
  return result;
}

TEST(Binder, FoundsAUnionOrJoinsOne) {
  EXPECT_EQ(next_step(ref, "", nullptr, ""), (BinderStep{Kind::create, "", "union of p", false}));
  EXPECT_EQ(next_step(ref, "", nullptr, "union of a"),
            (BinderStep{Kind::join, "", "union of a", false}));
}

TEST(Binder, MovesAndClearsAwayWhatIsEmpty) {
  const auto alone = union_with({"p"});
  const auto others = union_with({"b", "p"});
  EXPECT_EQ(next_step(ref, "union of p", &alone, "union of a"),
            (BinderStep{Kind::move, "union of p", "union of a", true}));
  EXPECT_EQ(next_step(ref, "union of b", &others, "union of a"),
            (BinderStep{Kind::move, "union of b", "union of a", false}));
  EXPECT_EQ(next_step(ref, "union of b", &others, ""),
            (BinderStep{Kind::move, "union of b", "union of p", false}));
  // The founder has left: who is first now founds another, and the rest will follow.
  const auto founded_by_another = union_with({"p", "q"});
  EXPECT_EQ(next_step(ref, "union of b", &founded_by_another, ""),
            (BinderStep{Kind::move, "union of b", "union of p", false}));
}

TEST(Binder, RenewsTheUnionThatFits) {
  const auto alone = union_with({"p", "q"});
  const auto others = union_with({"b", "p"});
  EXPECT_EQ(next_step(ref, "union of p", &alone, ""),
            (BinderStep{Kind::renew, "union of p", "union of p", false}));
  EXPECT_EQ(next_step(ref, "union of b", &others, "union of b"),
            (BinderStep{Kind::renew, "union of b", "union of b", false}));
}

class NoRelations final : public Surroundings {
  const BindingProxy* proxy(const std::string&) const override { return nullptr; }
  std::span<const Port> in_ports(const std::string& id) const override {
    return id == "b" ? std::span<const Port>{&port, 1} : std::span<const Port>{};
  }
  std::vector<ProxyRef> bound_with(const std::string&) const override { return {}; }

  Port port{"to", "b", "r"};
};

TEST(Binder, PutsTogetherWhatMembersSay) {
  const std::map<std::string, BindingProxy> proxies{
    {"a", with_precedence(proxy_from("comsys", {colour("red"), concept_of("ball")}), 1)},
    {"b", proxy_from("vision", {colour("red")})}};
  std::vector<ProxyRef> members;
  for (const auto& [id, x] : proxies)
    members.push_back({&id, &x});
  const auto made = make_union(members, NoRelations{});
  EXPECT_EQ(made.proxy_ids, (std::vector<std::string>{"b", "a"}));
  EXPECT_EQ(made.sources, (std::vector<std::string>{"vision", "comsys"}));
  EXPECT_EQ(made.features, (std::vector{colour("red"), colour("red"), concept_of("ball")}));
  EXPECT_EQ(made.in_ports, (std::vector<Port>{{"to", "b", "r"}}));
  const auto member = bound(proxies.at("a"), "union of b", made);
  EXPECT_EQ(member.union_id, "union of b");
  EXPECT_EQ(member.proxy_ids, made.proxy_ids);
  EXPECT_EQ(member.state, ProxyState::bound);
  EXPECT_EQ(member.binding_count, 1u);
}

} // namespace

} // namespace castor::binding::test
