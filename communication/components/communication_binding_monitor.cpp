#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/communication/components/asks_binding.hpp"
#include "castor/communication/dialogue/assertion.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/types.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

using binding::BindingProxy;
using binding::FeatureKind;

/// Binds what is said to what is there, move after move: finds what each move is about, and tells
/// binding of everything that is asserted.
class CommunicationBindingMonitor final : public AsksBinding<binding::BindingMonitor> {
  void start() override {
    BindingMonitor::start();
    on_change(added<DialogueMove>(),
              [this](const ChangeEvent& event) { moves_.insert(event.address.id); });
    on_binding_change(changed<BindingProxy>(), [](const ChangeEvent&) {});
    for (auto& x : read_all<DialogueMove>())
      moves_.insert(x.address.id);
    for (auto& x : read_all<MoveReferents>())
      history_.push_back(*x);
    std::ranges::sort(history_, {}, &MoveReferents::turn);
  }

  void run() override {
    do
      for (auto next = next_move(); next && is_running(); next = next_move())
        look(next->address.id, *next->object);
    while (wait_for_changes() || is_running());
  }

  /// The one that was said first.
  std::optional<EntryOf<DialogueMove>> next_move() {
    std::optional<EntryOf<DialogueMove>> result;
    for (auto id = moves_.begin(); id != moves_.end();)
      try {
        auto move = read<DialogueMove>(here(*id++));
        if (!result || move->turn < result->object->turn)
          result = std::move(move);
      } catch (const DoesNotExistOnWM&) {
        moves_.erase(std::prev(id));
      }
    if (result)
      moves_.erase(result->address.id);
    return result;
  }

  void look(const std::string& id, const DialogueMove& move) {
    auto address = here("referents of " + id);
    const bool is_known = exists(address);
    auto meant = move;
    auto referents = is_known ? *read<MoveReferents>(address) : referents_of(id, meant);
    if (meant.type == DialogueMoveType::assertion) {
      const auto told = tell_of(id, meant, referents);
      publish();
      for (auto& proxy : told)
        wait_until_bound(proxy);
    }
    if (is_known)
      return;
    history_.push_back(referents);
    if (history_.size() > remembered_)
      history_.erase(history_.begin());
    add(address, std::move(referents));
  }

  // -- what is spoken of

  /// Of the reading that makes sense, which `move` becomes.
  MoveReferents referents_of(const std::string& id, DialogueMove& move) {
    const auto antecedents = antecedents_in(move, history_);
    auto [meant, referents] = with_scene(binding(), [&](SceneKnowledge& scene) {
      auto reading = reading_of(move, respond(move, antecedents, scene).reading);
      auto spoken_of = communication::referents_of(reading, antecedents, scene);
      return std::pair{std::move(reading), std::move(spoken_of)};
    });
    MoveReferents result{
      {here(id)}, move.turn, move.problem.empty(), to_entry(antecedents), std::move(referents)};
    move = std::move(meant);
    return result;
  }

  // -- what is asserted

  /// What disagrees with what is perceived is not told.
  bool is_contradicted(const DialogueMove& move, const Nominal& root,
                       const Antecedents& antecedents) {
    return with_scene(binding(), [&](SceneKnowledge& scene) {
             Evaluation evaluation{move.content, antecedents, scene};
             try {
               return judge_assertion(root, move.content, evaluation);
             } catch (const Uninterpretable&) {
               return Truth::unknown;
             }
           }) == Truth::no;
  }

  /// \returns the proxies that binding was told
  std::vector<std::string> tell_of(const std::string& id, const DialogueMove& move,
                                   const MoveReferents& referents) {
    const auto& form = move.content;
    const auto* root = find_nominal(form, form.root);
    if (root == nullptr)
      return {};
    const auto telling = telling_of(*root, form);
    if (telling == Telling::nothing || is_contradicted(move, *root, from_entry(referents.pronouns)))
      return {};
    const auto* thing = dependent(form, *root, root->sort == "existence" ? "Subject" : "Cop-Restr");
    const auto* scope = dependent(form, *root, "Cop-Scope");
    BindingProxy proxy;
    // What is said is judged when what is seen has been.
    proxy.precedence = 1;
    proxy.features = features_of(form, *thing);
    if (scope != nullptr)
      for (auto& x : features_of(form, *scope))
        add_feature(proxy, is_negated(*root) && x.text != "thing" ? binding::negation_of(x) : x);
    proxy.features.push_back(
      binding::tether_to({here(id), std::string{type_name<DialogueMove>()}}));
    std::vector<std::string> meant;
    if (!is_deictic(*thing))
      for (auto& x : referents.referents)
        if (x.nominal == thing->name)
          meant = x.proxies;
    if (telling == Telling::of_one) {
      if (meant.size() == 1)
        add_feature(proxy, feature(FeatureKind::existing_proxy_id, meant.front()));
      tell(proxy_id(id), std::move(proxy));
      return {proxy_id(id)};
    }
    std::vector<std::string> told;
    for (auto& one : meant) {
      auto of_it = proxy;
      add_feature(of_it, feature(FeatureKind::existing_proxy_id, one));
      told.push_back(proxy_id(id) + '/' + std::to_string(told.size() + 1));
      tell(told.back(), std::move(of_it));
    }
    return told;
  }

  static void add_feature(BindingProxy& to, const binding::Feature& x) {
    if (std::ranges::find(to.features, x) == to.features.end())
      to.features.push_back(x);
  }

  /// So that what is said next can be about it.
  void wait_until_bound(const std::string& proxy) {
    const auto deadline = now() + patience_.get();
    while (is_running() && now() < deadline)
      try {
        if (read<BindingProxy>({binding(), proxy})->state == binding::ProxyState::bound)
          return;
        wait_for_changes(deadline - now());
      } catch (const DoesNotExistOnWM&) {
        return;
      } catch (const UnknownSubarchitectureException&) {
        return;
      }
  }

  static std::string proxy_id(const std::string& move) { return "communication/" + move; }

  Option<std::uint32_t> remembered_{this, "remembered", 100,
                                    "how many moves back something may be referred to"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", std::chrono::seconds{2},
    "how long an utterance waits until binding has processed the earlier ones"};

  std::set<std::string> moves_;
  std::vector<MoveReferents> history_;
};

CASTOR_COMPONENT(CommunicationBindingMonitor,
                 "resolves references, and adds what is asserted to binding")

} // namespace

} // namespace castor::communication
