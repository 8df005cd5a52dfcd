#include "castor/binding/binding_scorer.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_score.hpp"
#include "castor/binding/components/binding_component.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/features.hpp"
#include "castor/mapping/geometry/knows_frames.hpp"
#include "castor/mapping/geometry/poses.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// The components are named like the plain classes that they are made of.
namespace castor::binding::components {

namespace {

/// Scores every proxy against every union, and keeps the scores up to date.
class BindingScorer final : public geometry::KnowsFrames<BindingComponent> {
  void configure() override {
    ComparatorOptions options;
    options.same_place = same_place_;
    options.other_place = other_place_;
    options.frames = &frames();
    comparator_ = FeatureComparator{options};
  }

  void start() override {
    BindingComponent::start();
    auto competences_changed = [this](const ChangeEvent&) { competences_changed_ = true; };
    on_change(changed<FeatureComparisonCompetence>(), competences_changed);
    on_change(overwritten<FeatureComparison>(),
              [this](const ChangeEvent& event) { answered_.insert(event.address.id); });
    for (auto& name : frames_of_.get())
      know_frames_of(name);
    for (auto& x : read_all<FeatureComparison>())
      answered_.insert(x.address.id);
    for (auto& x : read_all<ProxyUnionScores>())
      scores_[x->proxy] = *x;
  }

  void work(const Changes& changes) override {
    auto all = learn_what_others_know();
    all = learn_how_frames_lie() || all;
    std::erase_if(scores_, [this](auto& x) {
      if (view().proxy(x.first))
        return false;
      drop(entry_id(x.first));
      return true;
    });
    for (auto& [id, proxy] : view().proxies())
      if (all || changes.proxies.contains(id) || !scores_.contains(id))
        score(id);
      else
        score(id, changes);
  }

  /// True if it may be that features compare otherwise than before.
  bool learn_what_others_know() {
    auto result = competences_changed_;
    if (update_ontology(comparator_))
      result = true;
    if (std::exchange(competences_changed_, false)) {
      for (auto& name : competent_)
        comparator_.remove(name);
      competent_.clear();
      for (auto& x : read_all<FeatureComparisonCompetence>()) {
        comparator_.add(*x);
        competent_.insert(x->subarchitecture);
      }
    }
    for (auto& id : std::exchange(answered_, {}))
      try {
        if (auto x = read<FeatureComparison>(here(id)); x->answered) {
          comparator_.answer(x->proxy_feature, x->union_feature, x->equivalent);
          result = true;
        }
      } catch (const DoesNotExistOnWM&) {
        trace("{} is gone", id);
      }
    return result;
  }

  void frames_changed() override { frames_changed_ = true; }

  /// True if locations may compare otherwise than before, since the frames of some have moved.
  bool learn_how_frames_lie() {
    if (!std::exchange(frames_changed_, false))
      return false;
    std::set<std::string> names;
    for (auto& [id, proxy] : view().proxies())
      for (auto& x : proxy->features)
        if (x.kind == FeatureKind::location)
          names.insert(x.text);
    auto before = std::exchange(poses_, {});
    for (auto& in : names)
      for (auto& frame : names)
        if (frame < in)
          if (auto pose = frames().find_pose(frame, in))
            poses_.emplace(std::pair{frame, in}, *pose);
    auto is_same = [this](const geometry::Pose& a, const geometry::Pose& b) {
      return geometry::distance(a.position, b.position) < same_place_ / 2 &&
             geometry::angle_between(a.rotation, b.rotation) < least_turn;
    };
    auto moved = before.size() != poses_.size();
    for (auto& [pair, pose] : poses_)
      if (auto x = before.find(pair); x == before.end() || !is_same(x->second, pose))
        moved = true;
      else
        pose = x->second; // many small moves are a large one
    return moved;
  }

  /// Against all unions.
  void score(const std::string& id) {
    ProxyUnionScores result{id, {{id, {}, nil_score()}}};
    for (auto& [union_id, x] : view().unions())
      add_score(result, union_id, *x);
    tell(std::move(result));
  }

  /// Against those that have changed, and, as relations depend on what becomes of others, against
  /// those that the proxy may belong to.
  void score(const std::string& id, const Changes& changes) {
    auto& known = scores_.at(id);
    ProxyUnionScores result{id, {}};
    for (auto& x : known.scores)
      if (x.union_id.empty() || (!view().has_ports(id) && !changes.unions.contains(x.union_id)))
        result.scores.push_back(x);
      else if (auto found = view().unions().find(x.union_id);
               found != view().unions().end() && !changes.unions.contains(x.union_id))
        add_score(result, x.union_id, *found->second);
    for (auto& union_id : changes.unions)
      if (auto x = view().unions().find(union_id); x != view().unions().end())
        add_score(result, union_id, *x->second);
    tell(std::move(result));
  }

  /// What features rule out, nothing brings back: most unions are not worth an entry's space.
  void add_score(ProxyUnionScores& to, const std::string& union_id, const BindingUnion& in) {
    auto x = score_in(to.proxy, in);
    if (x.comparable && !x.mismatch)
      to.scores.push_back({to.proxy, union_id, x});
  }

  BindingScore score_in(const std::string& id, const BindingUnion& in) {
    auto members = view().refs(in.proxy_ids);
    for (auto& member : members)
      if (*member.id != id)
        ask_others(*view().proxy(id), *member.proxy);
    return scorer_.score(view().ref(id), members, view());
  }

  void ask_others(const BindingProxy& proxy, const BindingProxy& member) {
    if (competent_.empty())
      return;
    for (auto& x : scorer_.open_comparisons(proxy, member)) {
      auto id =
        "comparison of " + to_string(x.proxy_feature) + " with " + to_string(x.union_feature);
      if (!asked_.insert(id).second)
        continue;
      try {
        add(here(id), x);
      } catch (const AlreadyExistsOnWM&) {
        answered_.insert(id);
      }
    }
  }

  void tell(ProxyUnionScores x) {
    std::ranges::sort(x.scores, {}, &ProxyUnionScore::union_id);
    auto& known = scores_[x.proxy];
    if (known == x)
      return;
    known = x;
    put(entry_id(known.proxy), std::move(x));
  }

  static std::string entry_id(const std::string& proxy) {
    return std::string{scores_prefix} + proxy;
  }

  Option<double> same_place_{this, "same-place", ComparatorOptions{}.same_place,
                             "locations at most this far apart are the same, metres"};
  Option<double> other_place_{this, "other-place", ComparatorOptions{}.other_place,
                              "locations at least this far apart are different, metres"};

  Option<std::vector<std::string>> frames_of_{
    this, "frames-of", {}, "subarchitectures whose Transforms relate the frames of locations"};

  /// Radians: where things are some metres from the middle, they move by some centimetres.
  static constexpr double least_turn = 0.01;

  FeatureComparator comparator_;
  binding::BindingScorer scorer_{comparator_};
  std::set<std::string> competent_;
  bool competences_changed_ = true;
  /// Comparisons that may have been answered, and all that were asked for, by their entries' ids.
  std::set<std::string> answered_;
  std::set<std::string> asked_;
  bool frames_changed_ = true;
  /// Of frames that locations are given in, in others of them.
  std::map<std::pair<std::string, std::string>, geometry::Pose> poses_;
  /// What stands on working memory.
  std::map<std::string, ProxyUnionScores> scores_;
};

CASTOR_COMPONENT(BindingScorer, "scores how well binding proxies fit into binding unions")

} // namespace

} // namespace castor::binding::components
