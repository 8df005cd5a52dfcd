#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of the communication working memory: what was said, what it may mean, and what is to
/// be said.
namespace castor::communication {

/// One hypothesis of what was heard: words as written, separated by blanks.
struct PhonString {
  std::string word_sequence;
  /// In words.
  std::int32_t length = 0;
  /// In [0, 1].
  double confidence = 1;
  /// The place among the hypotheses of one utterance, from 0 for the likeliest.
  std::int32_t rank = 0;
  /// How many utterances came before it.
  std::int32_t turn = 0;
};

/// <name>value of a nominal, such as <Number>sg.
struct NominalFeature {
  std::string name;
  std::string value;

  friend bool operator==(const NominalFeature&, const NominalFeature&) = default;
};

/// <mode>(dependent) of a nominal; `dependent` is the name of another nominal.
struct NominalRelation {
  std::string mode;
  std::string dependent;

  friend bool operator==(const NominalRelation&, const NominalRelation&) = default;
};

/// Something that a logical form speaks of: @name:sort(proposition ^ <Feature>value ^ <Relation>b).
struct Nominal {
  /// After the word that brings it: w3 for the third.
  std::string name;
  /// What kind of thing it is: thing, colour, region, action...
  std::string sort;
  /// What is said of it, mostly a word's citation form; empty if nothing.
  std::string proposition;
  std::vector<NominalFeature> features;
  std::vector<NominalRelation> relations;

  friend bool operator==(const Nominal&, const Nominal&) = default;
};

/// One meaning, a formula of hybrid-logic dependency semantics: a graph of nominals.
struct LogicalForm {
  std::string root;
  std::vector<Nominal> nominals;
  /// The higher the likelier; comparable among the readings of one utterance.
  double preference = 0;

  friend bool operator==(const LogicalForm&, const LogicalForm&) = default;
};

/// A reading of a packed logical form: a number that its alternatives carry.
struct Reading {
  std::int32_t id = 0;
  double preference = 0;

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// A sort, a proposition or a root, in these readings.
struct PackedValue {
  std::string value;
  std::vector<std::int32_t> readings;

  friend bool operator==(const PackedValue&, const PackedValue&) = default;
};

/// <name>value, in these readings.
struct PackedFeature {
  std::string name;
  std::string value;
  std::vector<std::int32_t> readings;

  friend bool operator==(const PackedFeature&, const PackedFeature&) = default;
};

/// <mode>(dependent), in these readings.
struct PackedRelation {
  std::string mode;
  std::string dependent;
  std::vector<std::int32_t> readings;

  friend bool operator==(const PackedRelation&, const PackedRelation&) = default;
};

/// A nominal with all that any reading says of it.
struct PackedNominal {
  std::string name;
  std::vector<PackedValue> sorts;
  std::vector<PackedValue> propositions;
  std::vector<PackedFeature> features;
  std::vector<PackedRelation> relations;

  friend bool operator==(const PackedNominal&, const PackedNominal&) = default;
};

/// A part of an utterance that was not understood.
struct Unparsable {
  /// From this word, counted from 0, so many.
  std::int32_t first_word = 0;
  std::int32_t words = 0;
  std::string text;
  /// What is wrong with it, for people to read.
  std::string reason;
  /// What may have been meant, the likeliest first.
  std::vector<std::string> suggestions;

  friend bool operator==(const Unparsable&, const Unparsable&) = default;
};

enum class InterpretationState {
  /// More words may come; the forms are partial ones.
  unfinished,
  /// All words have been heard.
  finished,
  /// Finished, and readings have been removed by what else is known.
  pruned
};

/// All readings of an utterance in one form, overwritten after each word. What is common to
/// readings is there once; every alternative carries the readings that it belongs to, so pruning is
/// removing readings.
struct PackedLogicalForm {
  EntryPointer<PhonString> utterance;
  /// Its words.
  std::string text;
  /// How many utterances came before it.
  std::int32_t turn = 0;
  /// So many words of it have been heard.
  std::int32_t string_position = 0;
  InterpretationState state = InterpretationState::unfinished;
  /// The likeliest first; empty if nothing was understood.
  std::vector<Reading> readings;
  /// What the readings are about; several of one reading are fragments that nothing connects.
  std::vector<PackedValue> roots;
  std::vector<PackedNominal> nominals;
  std::vector<Unparsable> unparsable;

  friend bool operator==(const PackedLogicalForm&, const PackedLogicalForm&) = default;
};

/// What other knowledge says of one relation of a packed logical form, as of the attachment of
/// "near the box" to something that is seen near a box, or not.
struct InterpretationSupport {
  std::string head;
  std::string mode;
  std::string dependent;
  bool supported = true;

  friend bool operator==(const InterpretationSupport&, const InterpretationSupport&) = default;
};

/// There is a component that says which readings the rest of the system supports. Goes with it.
struct ContextSource {
  std::string component;
};

/// What such a component says of a finished form that has several readings.
struct ContextInfo {
  EntryPointer<PackedLogicalForm> form;
  std::vector<InterpretationSupport> supports;
};

enum class DialogueMoveType {
  none,
  assertion,
  action_directive,
  question_w,
  question_yn,
  opening,
  closing,
  accept,
  reject
};

/// What somebody does by saying a logical form.
struct DialogueMove {
  DialogueMoveType type = DialogueMoveType::none;
  LogicalForm content;
  /// How many utterances came before it.
  std::int32_t turn = 0;
  /// What to say of what was not understood; else empty.
  std::string problem;
  EntryPointer<PhonString> utterance;
};

/// Something that a dialogue move speaks of, and that may be spoken of again.
struct DiscourseReferent {
  /// The nominal that brought it up.
  std::string nominal;
  std::string proposition;
  bool is_plural = false;
  /// What it may be: proxies of what is perceived, one if it is certain.
  std::vector<std::string> proxies;

  friend bool operator==(const DiscourseReferent&, const DiscourseReferent&) = default;
};

/// What a dialogue move speaks of. It is there when everything said before is known to binding.
struct MoveReferents {
  EntryPointer<DialogueMove> move;
  std::int32_t turn = 0;
  /// The one that the move is about first.
  std::vector<DiscourseReferent> referents;
};

/// How a turn of a dialogue is connected with one before it.
enum class RhetoricalRelation {
  /// Something new.
  narration,
  answer,
  acceptance,
  correction,
  clarification_question,
  clarification,
  greeting,
};

struct DialogueTurn {
  /// "human" or "robot".
  std::string speaker;
  /// A DialogueMove or a SpokenOutputItem.
  AnyEntryPointer contribution;
  DialogueMoveType type = DialogueMoveType::none;
  RhetoricalRelation relation = RhetoricalRelation::narration;
  /// The contribution that it is connected with; null for something new.
  AnyEntryPointer to;

  friend bool operator==(const DialogueTurn&, const DialogueTurn&) = default;
};

/// One entry: who said what, and in reply to what.
struct DialogueStructure {
  std::vector<DialogueTurn> turns;
};

/// What is to be said: a logical form for the realiser.
struct ContentPlanningGoal {
  LogicalForm content;
  /// The dialogue move that this is a reply to, and the utterance of that; null for what is said
  /// unasked.
  EntryPointer<DialogueMove> reply_to;
  EntryPointer<PhonString> utterance;
  RhetoricalRelation relation = RhetoricalRelation::narration;
};

/// What is said, or was.
struct SpokenOutputItem {
  std::string text;
  /// As in ContentPlanningGoal.
  EntryPointer<DialogueMove> reply_to;
  EntryPointer<PhonString> utterance;
  RhetoricalRelation relation = RhetoricalRelation::narration;
};

CASTOR_REFLECT(PhonString, word_sequence, length, confidence, rank, turn)
CASTOR_REFLECT(NominalFeature, name, value)
CASTOR_REFLECT(NominalRelation, mode, dependent)
CASTOR_REFLECT(Nominal, name, sort, proposition, features, relations)
CASTOR_REFLECT(LogicalForm, root, nominals, preference)
CASTOR_REFLECT(Reading, id, preference)
CASTOR_REFLECT(PackedValue, value, readings)
CASTOR_REFLECT(PackedFeature, name, value, readings)
CASTOR_REFLECT(PackedRelation, mode, dependent, readings)
CASTOR_REFLECT(PackedNominal, name, sorts, propositions, features, relations)
CASTOR_REFLECT(Unparsable, first_word, words, text, reason, suggestions)
CASTOR_REFLECT_ENUM(InterpretationState, unfinished, finished, pruned)
CASTOR_REFLECT(PackedLogicalForm, utterance, text, turn, string_position, state, readings, roots,
               nominals, unparsable)
CASTOR_REFLECT(InterpretationSupport, head, mode, dependent, supported)
CASTOR_REFLECT_ENUM(DialogueMoveType, none, assertion, action_directive, question_w, question_yn,
                    opening, closing, accept, reject)
CASTOR_REFLECT(ContextSource, component)
CASTOR_REFLECT(ContextInfo, form, supports)
CASTOR_REFLECT(DialogueMove, type, content, turn, problem, utterance)
CASTOR_REFLECT(DiscourseReferent, nominal, proposition, is_plural, proxies)
CASTOR_REFLECT(MoveReferents, move, turn, referents)
CASTOR_REFLECT_ENUM(RhetoricalRelation, narration, answer, acceptance, correction,
                    clarification_question, clarification, greeting)
CASTOR_REFLECT(DialogueTurn, speaker, contribution, type, relation, to)
CASTOR_REFLECT(DialogueStructure, turns)
CASTOR_REFLECT(ContentPlanningGoal, content, reply_to, utterance, relation)
CASTOR_REFLECT(SpokenOutputItem, text, reply_to, utterance, relation)

} // namespace castor::communication
