#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/learning/learned_words_file.hpp"
#include "castor/perception/vision/learning/word_learner.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::vision {

namespace {

/// Learns what things are called, and tells those who name things by its one entry of LearnedWords.
class VisualLearner final : public ManagedComponent {
  void configure() override {
    if (!file_->empty())
      words_ = load_learned_words(file_.get());
  }

  void start() override {
    on_change(added<LearnInstruction>(), [this](const ChangeEvent& event) { look(event.address); });
    on_change(changed(&ROI::has_features), [this](const ChangeEvent&) { look_again(); });
    on_change(deleted<ROI>(), [this](const ChangeEvent&) { look_again(); });
    on_change(deleted<SceneObject>(), [this](const ChangeEvent&) { look_again(); });
    // A predecessor's entry has what the file has, or more.
    for (auto& x : read_all<LearnedWords>()) {
      entry_ = x.address;
      words_ = x->words;
      save();
    }
    if (!entry_ && !words_.empty())
      entry_ = add(LearnedWords{words_});
    for (auto& x : read_all<LearnInstruction>())
      look(x.address);
  }

  void look(const Address& instruction) {
    propose_task("learn a word", [this, instruction] { learn(instruction); });
  }

  /// At what waits for features.
  void look_again() {
    for (auto& x : std::exchange(waiting_, {}))
      look(x);
  }

  void learn(const Address& address) {
    try {
      auto instruction = read<LearnInstruction>(address);
      auto roi = find_region(instruction->target_id);
      if (roi && !roi->has_features) {
        waiting_.insert(address);
        return;
      }
      if (!roi)
        warning("there is nothing to learn from {}: no object, and no region, has this id",
                instruction->target_id);
      settle(address, roi ? with(instruction->attributes, roi->features) : words_);
    } catch (const DoesNotExistOnWM&) {
      debug("{} was taken back", address.id);
    }
  }

  /// The region with this id, or that of the object with this id.
  std::optional<ROI> find_region(const std::string& id) {
    for (auto& x : read_all<ROI>())
      if (x.address.id == id || x->object_id == id)
        return *x;
    return std::nullopt;
  }

  /// What is known with these examples.
  std::vector<LearnedWord> with(const std::vector<Attribute>& attributes,
                                const RegionFeatures& features) {
    WordLearner learner{words_};
    for (auto& x : attributes) {
      try {
        learner.learn(x.kind, x.value.value, WordLearner::evidence(x.kind, features),
                      x.value.confidence);
        info("this is a {} called {}", x.kind, x.value.value);
      } catch (const std::invalid_argument& e) {
        warning("cannot learn the {} '{}': {}", x.kind, x.value.value, e.what());
      }
    }
    return learner.words();
  }

  /// Deletes the instruction together with telling what was learned from it: whenever this
  /// component may fail, nothing is learned twice.
  void settle(const Address& instruction, std::vector<LearnedWord> words) {
    WriteBatch batch;
    batch.delete_entry(instruction);
    auto entry = entry_ ? *entry_ : here(new_id());
    auto is_news = words != words_;
    if (is_news && entry_)
      batch.overwrite(entry, LearnedWords{words});
    else if (is_news)
      batch.add(entry, LearnedWords{words});
    write(batch);
    if (!is_news)
      return;
    entry_ = entry;
    words_ = std::move(words);
    save();
  }

  void save() {
    if (!file_->empty())
      save_learned_words(file_.get(), words_);
  }

  Option<std::string> file_{this, "words", "",
                            "file that keeps what was learned from run to run; none if empty"};

  std::vector<LearnedWord> words_;
  std::optional<Address> entry_;
  std::set<Address> waiting_;
};

CASTOR_COMPONENT(VisualLearner, "learns what colours and shapes are called, by instructions")

} // namespace

} // namespace castor::vision
