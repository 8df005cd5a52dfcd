#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/communication/components/asks_binding.hpp"
#include "castor/communication/dialogue/assertion.hpp"
#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/pointing.hpp"
#include "castor/communication/dialogue/presence.hpp"
#include "castor/communication/dialogue/proposals.hpp"
#include "castor/communication/dialogue/question_context.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/motivation/types.hpp"

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

/// Binds what is said to what is there, move after move: finds what each move is about, and tells
/// binding of everything that is asserted.
class CommunicationBindingMonitor final : public AsksBinding<binding::BindingMonitor> {
  void start() override {
    BindingMonitor::start();
    on_change(added<DialogueMove>(),
              [this](const ChangeEvent& event) { moves_.insert(event.address.id); });
    started_ = now();
    on_binding_change(changed<BindingProxy>(),
                      [this](const ChangeEvent&) { last_change_ = now(); });
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
    note_choices();
    if (const auto renamed = renamed_things(table_.get(), binding()); !renamed.empty()) {
      for (auto& x : history_)
        rename(x, renamed);
      if (questions_)
        questions_->rename(renamed);
    }
    const bool is_known = exists(address);
    const auto said = with_names_told(move, *vocabulary(binding()));
    if (!is_known)
      wait_for_what_is_named(id, said);
    auto meant = said;
    auto referents = is_known ? *read<MoveReferents>(address) : referents_of(id, meant);
    auto spoken_of = referents;
    const auto whole = completed(said, spoken_of);
    if (whole.type == DialogueMoveType::assertion) {
      const auto told = tell_of(id, whole, spoken_of);
      publish();
      for (auto& proxy : told)
        wait_until_bound(proxy);
    }
    if (whole.partial) {
      referents.is_unclear = true;
    } else if (asks_to_act(whole)) {
      referents.steps = with_scene(binding(), [&](SceneKnowledge& scene) {
        return steps_asked_for(whole, from_entry(spoken_of.pronouns), scene);
      });
      referents.asks_whether_possible = asks_for_ability(whole.content);
      referents.corrects = is_correction(whole.content);
      referents.comes_first = is_to_be_first(whole.content);
      referents.is_unclear = whole.problem.empty() && referents.steps.empty() &&
                             is_handling(whole.content, vocabulary(binding())->meanings());
      if (whole.utterance != said.utterance && is_agreement(said))
        referents.agrees_to = whole.utterance;
    }
    if (is_known)
      return;
    referents.referents = spoken_of.referents;
    history_.push_back(referents);
    if (history_.size() > remembered_)
      history_.erase(history_.begin());
    add(address, std::move(referents));
  }

  /// What somebody names may be on the table, but not bound yet: not until binding has been idle
  /// for a while is there nothing like it.
  void wait_for_what_is_named(const std::string& id, const DialogueMove& move) {
    const auto given_up = now() + search_.get();
    while (is_running() && now() < given_up && !has_settled() && finds_nothing_like_it(id, move))
      wait_for_changes(look_every);
  }

  bool has_settled() {
    const auto quiet = now() - last_change_.value_or(started_);
    if (!last_change_)
      return quiet >= search_.get();
    try {
      return quiet >= settled_.get() &&
             read<binding::BinderStatus>({binding(), binding::binder_status})->stable;
    } catch (const WorkingMemoryException&) {
      return true;
    }
  }

  bool finds_nothing_like_it(const std::string& id, DialogueMove move) {
    const auto referents = referents_of(id, move);
    if (!questions_)
      questions_.emplace(vocabulary(binding()));
    const auto whole = questions_->complete(move, from_entry(referents.pronouns));
    const auto response = with_scene(binding(), [&](SceneKnowledge& scene) {
      return respond(whole.move, whole.antecedents, scene);
    });
    return response.relation == RhetoricalRelation::correction;
  }

  /// What who does it has chosen, where requests before left that open.
  void note_choices() {
    if (motivation_->empty())
      return;
    for (const auto& told : read_all_in<planning::MotiveAcknowledgement>(motivation_))
      if (!told->things.empty())
        for (auto& x : history_)
          if (told->cause.address == x.move.address)
            note_chosen(x, told->things);
  }

  // -- what is spoken of

  /// Of the reading that makes sense, which `move` becomes.
  MoveReferents referents_of(const std::string& id, DialogueMove& move) {
    MoveReferents result{{here(id)}, move.turn, move.problem.empty(), {}, {}, {}};
    const auto place = place_pointed_at(result.pointing);
    auto meant = with_scene(binding(), [&](SceneKnowledge& scene) {
      auto antecedents = antecedents_in(move, history_, scene.vocabulary());
      antecedents.merge(antecedents_by_presence(move, scene));
      if (place) {
        auto shown = antecedents_by_pointing(move, *place, antecedents, scene, reach_);
        result.pointing->taken_up = !shown.empty();
        antecedents.merge(std::move(shown));
      }
      auto reading = reading_of(move, respond(move, antecedents, scene).reading);
      result.referents = communication::referents_of(reading, antecedents, scene);
      result.pronouns = to_entry(antecedents);
      return reading;
    });
    move = std::move(meant);
    return result;
  }

  /// The move with what it leaves to those before it.
  /// \param referents become those of the whole
  DialogueMove completed(const DialogueMove& move, MoveReferents& referents) {
    const auto& words = vocabulary(binding());
    if (!questions_)
      questions_.emplace(words);
    questions_->set_vocabulary(words);
    const auto whole = questions_->complete(move, from_entry(referents.pronouns));
    auto response = with_scene(binding(), [&](SceneKnowledge& scene) {
      auto result = respond(whole.move, whole.antecedents, scene);
      referents.referents = communication::referents_of(reading_of(whole.move, result.reading),
                                                        whole.antecedents, scene);
      return result;
    });
    referents.pronouns = to_entry(whole.antecedents);
    questions_->note(whole, response);
    return reading_of(whole.move, response.reading);
  }

  /// Where somebody points, unless it was too long ago.
  /// \param use becomes the gesture, if there was any
  std::optional<Place> place_pointed_at(std::optional<PointingUse>& use) {
    const auto latest = read_all<Pointing>(1);
    if (latest.empty())
      return std::nullopt;
    const auto& pointing = *latest.front();
    use = PointingUse{{latest.front().address}, latest.front().version, false};
    const PointingLimits limits{reach_, pointed_utterances_, pointed_time_.get()};
    if (is_stale(pointing, *use, history_, now(), limits))
      return std::nullopt;
    return Place{pointing.x, pointing.y};
  }

  // -- what is asserted

  /// \returns the proxies that binding was told
  std::vector<std::string> tell_of(const std::string& id, const DialogueMove& move,
                                   const MoveReferents& referents) {
    auto telling =
      with_scene(binding(), [&](SceneKnowledge& scene) { return told_by(move, referents, scene); });
    std::vector<std::string> told;
    for (auto& features : telling.proxies) {
      BindingProxy proxy;
      // What is said is judged when what is seen has been.
      proxy.precedence = 1;
      proxy.features = std::move(features);
      proxy.features.push_back(
        binding::tether_to({here(id), std::string{type_name<DialogueMove>()}}));
      told.push_back(telling.telling == Telling::of_one
                       ? proxy_id(id)
                       : proxy_id(id) + '/' + std::to_string(told.size() + 1));
      tell(told.back(), std::move(proxy));
    }
    return told;
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

  Option<SubarchitectureName> motivation_{this, "motivation", "",
                                          "the subarchitecture of motives; empty if there is none"};
  Option<SubarchitectureName> table_{
    this, "table", "", "the subarchitecture that knows what was moved; empty if there is none"};
  Option<std::uint32_t> remembered_{this, "remembered", 100,
                                    "how many moves back something may be referred to"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", std::chrono::seconds{2},
    "how long an utterance waits until binding has processed the earlier ones"};

  Option<std::chrono::milliseconds> settled_{
    this, "settled", std::chrono::milliseconds{500},
    "there is nothing like what somebody names when binding has been idle for so long"};
  Option<std::chrono::milliseconds> search_{
    this, "search", std::chrono::seconds{5},
    "the longest wait for binding to be idle when there is nothing like what somebody names"};
  Option<double> reach_{this, "reach", PointingLimits{}.reach,
                        "how far what is pointed at may be from the place, metres"};
  Option<std::uint32_t> pointed_utterances_{
    this, "pointed-utterances", static_cast<std::uint32_t>(PointingLimits{}.utterances),
    "after so many utterances that are not about it, nothing is pointed at any more"};
  Option<std::chrono::milliseconds> pointed_time_{
    this, "pointed-time",
    std::chrono::duration_cast<std::chrono::milliseconds>(PointingLimits{}.age),
    "nor after this time, if it is known when it was pointed at"};

  static constexpr std::chrono::milliseconds look_every{100};

  Timestamp started_{0};
  std::optional<Timestamp> last_change_;
  std::set<std::string> moves_;
  std::vector<MoveReferents> history_;
  std::optional<QuestionContext> questions_;
};

CASTOR_COMPONENT(CommunicationBindingMonitor,
                 "resolves references, and adds what is asserted to binding")

} // namespace

} // namespace castor::communication
