#pragma once

#include "castor/binding/binding_order.hpp"
#include "castor/binding/binding_scorer.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor::binding {

/// What a change of proxies makes of the unions.
struct BindingChange {
  /// New ones and those with other members or other content.
  std::vector<std::string> changed;
  std::vector<std::string> removed;
  /// Proxies that are in another union than before; new ones included.
  std::vector<std::string> moved;
};

/// Scorer, judge and binder in one, without anything in between: proxies come, change and go, and
/// the unions are what they have to be.
///
/// What they have to be follows from the proxies alone. In binding order (BindingRank), each proxy
/// is scored against the unions of those before it, and joins the best one that beats NIL, or
/// founds one. A change is propagated in the same order: what it invalidates is computed again
/// once, when everybody before has been. So it ends, and it does not matter in which order proxies
/// have come; one that goes leaves no trace.
class BindingCore final : private RelationContext {
public:
  explicit BindingCore(ComparatorOptions options = {});

  BindingCore(const BindingCore&) = delete;
  BindingCore& operator=(const BindingCore&) = delete;

  /// Adds a proxy, or replaces the one of this id. What binding writes into a proxy is ignored.
  BindingChange set(const std::string& id, BindingProxy proxy);

  /// Nothing happens if there is none.
  BindingChange remove(const std::string& id);

  /// Somebody can compare more than the scorer can.
  BindingChange add(FeatureComparisonCompetence competence);

  /// Nobody is there any more who could.
  BindingChange remove_competences(const std::string& subarchitecture);

  /// An answer of theirs.
  BindingChange answer(const Feature& a, const Feature& b, Truth equivalent);

  const std::map<std::string, BindingUnion>& unions() const { return unions_; }

  /// Empty if there is no such proxy.
  std::string union_of(const std::string& id) const;

  /// The unions that suit the proxy best, of those before it; the first is the one that it is in.
  /// Empty if it founded its own.
  BestUnionsForProxy best_unions(const std::string& id) const;

  /// Set if there was more than one choice.
  std::optional<Ambiguity> ambiguity(const std::string& id) const;

  /// What others should be asked because of this proxy.
  std::vector<FeatureComparison> open_comparisons(const std::string& id) const;

  const FeatureComparator& comparator() const { return comparator_; }

  std::size_t size() const { return nodes_.size(); }

private:
  struct Node;

  struct Candidate {
    Node* first = nullptr;
    BindingScore score;
  };

  struct Node {
    BindingRank rank;
    BindingProxy proxy;
    KindSet kinds = 0;
    /// What it can be compared by.
    KindSet beside = 0;
    /// It is a relation or has some.
    bool has_ports = false;
    /// The first member of its union; nullptr while it is between two.
    Node* first = nullptr;
    /// Of a union's first member: all, in order, and the kinds of what they say.
    std::vector<Node*> members;
    std::vector<ProxyRef> refs;
    KindSet member_kinds = 0;
    /// The best unions, none for NIL.
    std::vector<Candidate> best;

    ProxyRef ref() const { return {&rank.id, &proxy}; }
    bool is_first() const { return first == this; }
  };

  struct ByRank {
    bool operator()(const Node* a, const Node* b) const { return a->rank < b->rank; }
  };

  /// What of a proxy has to be computed again.
  struct Invalidation {
    /// Everything may have changed; else only these unions.
    bool all = false;
    std::vector<Node*> unions;
  };

  const BindingProxy* proxy(const std::string& id) const override;
  std::span<const Port> in_ports(const std::string& id) const override;
  std::vector<ProxyRef> bound_with(const std::string& id) const override;

  Node* find(const std::string& id) const;
  void put_in(const std::string& id, BindingProxy proxy);
  void take_out(Node& x);
  void link_ports(const Node& x);
  void unlink_ports(const Node& x);
  void update_has_ports(const std::string& id);

  void invalidate(Node& x);
  void invalidate_all();
  void invalidate(Node& x, Node& first);
  bool may_affect(const Node& whom, const Node& what) const;
  void invalidate_after(const Node& x, std::initializer_list<Node*> unions);
  void invalidate_related(const Node& x, const Node* after);
  std::vector<Node*> related(const Node& x) const;

  BindingChange propagate();
  void judge_all(Node& x);
  void judge_union(Node& x, Node& first);
  void consider(Node& x, Node& first, const BindingScore& score);
  void move(Node& x, Node& first);
  void leave(Node& x);
  void dissolve(Node& first);
  void update_members(Node& first);
  BindingChange publish();

  FeatureComparator comparator_;
  BindingScorer scorer_{comparator_};
  std::map<BindingRank, Node> nodes_;
  std::unordered_map<std::string, Node*> by_id_;
  std::unordered_map<std::string, std::vector<Port>> in_ports_;
  std::map<Node*, Invalidation, ByRank> dirty_;
  /// By their first member's id.
  std::set<std::string> touched_unions_;
  std::set<std::string> touched_proxies_;
  std::map<std::string, BindingUnion> unions_;
  std::unordered_map<std::string, std::string> union_of_;
};

} // namespace castor::binding
