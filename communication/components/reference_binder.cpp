#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/types.hpp"
#include "castor/communication/components/asks_binding.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Asks binding which readings of an utterance the scene supports: "the ball near the box" is one
/// thing only where a ball is near a box.
class ReferenceBinder final : public AsksBinding<UnmanagedComponent> {
  void start() override {
    on_change(changed<PackedLogicalForm>(), [this](const ChangeEvent& event) {
      if (event.operation != Operation::remove)
        look(event.address);
    });
    add(here(new_id()), ContextSource{component_name()}, {.ephemeral = true});
    for (auto& x : read_all<PackedLogicalForm>())
      look(x.address);
  }

  void look(const Address& address) {
    try {
      auto form = read<PackedLogicalForm>(address);
      if (form->state == InterpretationState::finished)
        add(here("context of " + address.id), ContextInfo{{address}, supports_of(*form)});
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    } catch (const AlreadyExistsOnWM&) {
      trace("{} was looked at before", address.id);
    }
  }

  /// Each attachment of a place to a thing that some readings have.
  std::vector<InterpretationSupport> supports_of(const PackedLogicalForm& packed) {
    std::vector<InterpretationSupport> supports;
    std::vector<binding::Description> descriptions;
    if (packed.readings.size() < 2)
      return supports;
    const auto words = vocabulary(binding_.get());
    for (auto& reading : packed.readings)
      for (auto& form : unpack(packed, reading.id))
        for (auto& thing : form.nominals)
          collect(form, thing, *words, supports, descriptions);
    if (auto reply = ask(binding_.get(), {std::move(descriptions)}))
      for (std::size_t i = 0; i < supports.size() && i < reply->referents.size(); ++i)
        supports[i].supported = !reply->referents[i].readings.empty();
    return merged(std::move(supports));
  }

  static void collect(const LogicalForm& form, const Nominal& thing, const Vocabulary& words,
                      std::vector<InterpretationSupport>& supports,
                      std::vector<binding::Description>& descriptions) {
    if (thing.sort != "thing")
      return;
    for (auto& [mode, dependent] : thing.relations) {
      const auto* region = find_nominal(form, dependent);
      if (mode != "Location" || region == nullptr)
        continue;
      auto meaning = describe_as(form, without_places(form, thing), *region, words);
      if (!meaning.not_understood.empty() || meaning.description.relations.empty())
        continue;
      supports.push_back({thing.name, mode, dependent, true});
      descriptions.push_back(std::move(meaning.description));
    }
  }

  static Nominal without_places(const LogicalForm& form, Nominal thing) {
    std::erase_if(thing.relations, [&form](auto& relation) {
      const auto* dependent = find_nominal(form, relation.dependent);
      return dependent == nullptr || dependent->sort == "region";
    });
    return thing;
  }

  /// The same attachment may be part of several readings: one that makes sense is enough.
  static std::vector<InterpretationSupport> merged(std::vector<InterpretationSupport> all) {
    std::vector<InterpretationSupport> result;
    for (auto& x : all) {
      auto known = std::ranges::find_if(result, [&x](auto& y) {
        return x.head == y.head && x.mode == y.mode && x.dependent == y.dependent;
      });
      if (known == result.end())
        result.push_back(std::move(x));
      else
        known->supported |= x.supported;
    }
    return result;
  }

  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};
};

CASTOR_COMPONENT(ReferenceBinder, "asks binding which readings of an utterance the scene supports")

} // namespace

} // namespace castor::communication
