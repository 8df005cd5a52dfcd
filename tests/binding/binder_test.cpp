#include "castor/binding/binder.hpp"

#include "castor/tests/binding/proxies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::binding::test {

namespace {

using Best = std::map<std::string, std::string>;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Key;

/// Proxies in unions of these names; "" for those that are in none.
BindingView view_of(const Best& places) {
  BindingView result;
  std::map<std::string, std::vector<std::string>> members;
  for (const auto& [id, place] : places)
    if (!place.empty())
      members[place].push_back(id);
  for (const auto& [id, place] : places) {
    auto proxy = proxy_from("vision", {});
    proxy.union_id = place;
    if (!place.empty())
      proxy.proxy_ids = members[place];
    result.set(id, std::make_shared<const BindingProxy>(proxy));
  }
  for (const auto& [id, ids] : members)
    result.set(id, std::make_shared<const BindingUnion>(make_union(result.refs(ids), result)));
  return result;
}

TEST(Binder, FoundsUnionsAndLetsOthersJoin) {
  const auto view = view_of({{"a", "union of a"}, {"p", ""}, {"q", ""}, {"r", ""}});
  const auto plan = plan_binding(view, {{"a", ""}, {"p", ""}, {"q", "union of a"}});
  EXPECT_THAT(plan.unions, ElementsAre(Key("union of a"), Key("union of p")));
  EXPECT_THAT(plan.unions.at("union of a").proxy_ids, ElementsAre("a", "q"));
  EXPECT_EQ(plan.unions.at("union of a").updates, 1u);
  EXPECT_THAT(plan.proxies, ElementsAre(Key("a"), Key("p"), Key("q"))) << "r is not judged yet";
  EXPECT_EQ(plan.proxies.at("q").union_id, "union of a");
  EXPECT_THAT(plan.proxies.at("a").proxy_ids, ElementsAre("a", "q"));
}

TEST(Binder, MovesAndClearsAwayWhatIsEmpty) {
  const auto view = view_of({{"a", "union of a"}, {"p", "union of p"}});
  const auto plan = plan_binding(view, {{"a", ""}, {"p", "union of a"}});
  EXPECT_THAT(plan.unions, ElementsAre(Key("union of a")));
  EXPECT_THAT(plan.deleted_unions, ElementsAre("union of p"));
}

TEST(Binder, LetsAFounderLeaveThoseBehindWhoJoined) {
  const auto view = view_of({{"a", "union of a"}, {"b", "union of b"}, {"c", "union of b"}});
  const auto plan = plan_binding(view, {{"a", ""}, {"b", "union of a"}, {"c", "union of b"}});
  EXPECT_THAT(plan.unions.at("union of b").proxy_ids, ElementsAre("c"));
  EXPECT_THAT(plan.deleted_unions, IsEmpty());
}

TEST(Binder, WaitsForUnionsThatDoNotExist) {
  const auto view = view_of({{"p", "union of p"}, {"q", ""}});
  EXPECT_TRUE(plan_binding(view, {{"p", "union of x"}, {"q", "union of x"}}).empty());
}

TEST(Binder, TakesOutWhoLeaves) {
  const auto view = view_of({{"a", "union of a"}, {"p", "union of a"}, {"q", "union of q"}});
  const auto plan = plan_binding(view, {}, {"p", "q"});
  EXPECT_THAT(plan.unions.at("union of a").proxy_ids, ElementsAre("a"));
  EXPECT_THAT(plan.deleted_unions, ElementsAre("union of q"));
  EXPECT_THAT(plan.proxies, ElementsAre(Key("a")));
}

TEST(Binder, RenewsAUnionWhoseMembersSaySomethingElse) {
  auto view = view_of({{"a", "union of a"}, {"b", "union of b"}});
  EXPECT_TRUE(plan_binding(view, {{"a", ""}, {"b", ""}}).empty());
  auto changed = *view.proxy("a");
  changed.features = {colour("red")};
  view.set("a", std::make_shared<const BindingProxy>(changed));
  const auto plan = plan_binding(view, {{"a", ""}, {"b", ""}});
  EXPECT_THAT(plan.unions.at("union of a").features, ElementsAre(colour("red")));
  EXPECT_EQ(plan.unions.size(), 1u);
  EXPECT_THAT(plan.proxies, IsEmpty()) << "they are where they were";
}

class NoRelations final : public RelationContext {
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
