#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Entry types of the communication working memory: utterances, their meanings, and replies.
namespace castor::communication {

/// One hypothesis of a heard utterance: words as written, separated by blanks.
struct PhonString {
  std::string word_sequence;
  /// In words.
  std::int32_t length = 0;
  /// In [0, 1].
  double confidence = 1;
  /// Rank among the hypotheses of one utterance, from 0 for the likeliest.
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

/// A node of a logical form: @name:sort(proposition ^ <Feature>value ^ <Relation>b).
struct Nominal {
  /// Derived from the word that introduces it: w3 for the third.
  std::string name;
  /// Kind of the nominal: thing, colour, region, action...
  std::string sort;
  /// Its predicate, mostly a word's citation form; empty if there is none.
  std::string proposition;
  std::vector<NominalFeature> features;
  std::vector<NominalRelation> relations;

  friend bool operator==(const Nominal&, const Nominal&) = default;
};

/// One meaning, a formula of hybrid-logic dependency semantics: a graph of nominals.
struct LogicalForm {
  std::string root;
  std::vector<Nominal> nominals;
  /// Higher is likelier; comparable among the readings of one utterance.
  double preference = 0;

  friend bool operator==(const LogicalForm&, const LogicalForm&) = default;
};

/// A reading of a packed logical form: a number that its alternatives carry.
struct Reading {
  std::int32_t id = 0;
  double preference = 0;

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// A sort, a proposition or a root, and the readings that have it.
struct PackedValue {
  std::string value;
  std::vector<std::int32_t> readings;

  friend bool operator==(const PackedValue&, const PackedValue&) = default;
};

/// <name>value, and the readings that have it.
struct PackedFeature {
  std::string name;
  std::string value;
  std::vector<std::int32_t> readings;

  friend bool operator==(const PackedFeature&, const PackedFeature&) = default;
};

/// <mode>(dependent), and the readings that have it.
struct PackedRelation {
  std::string mode;
  std::string dependent;
  std::vector<std::int32_t> readings;

  friend bool operator==(const PackedRelation&, const PackedRelation&) = default;
};

/// A nominal with its properties in all readings.
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
  /// First word, counted from 0, and number of words.
  std::int32_t first_word = 0;
  std::int32_t words = 0;
  std::string text;
  /// Readable description of the error.
  std::string reason;
  /// Suggested replacements, the likeliest first.
  std::vector<std::string> suggestions;

  friend bool operator==(const Unparsable&, const Unparsable&) = default;
};

/// A word that is not known, and the one that it was taken for; or words, and nothing, if they were
/// left out.
struct SpellingCorrection {
  std::string word;
  std::string meant;

  friend bool operator==(const SpellingCorrection&, const SpellingCorrection&) = default;
};

/// A request in an utterance of which the rest is not understood: it is only done if who said it
/// agrees to it.
struct PartialRequest {
  /// The words that are not understood; empty if they say nothing.
  std::string left_out;
  /// Those of the request, or if the place is not understood, what is to be put somewhere, as the
  /// robot says it: "put your ball". Empty once another fragment has changed what is meant.
  std::string words;
  /// It is the place where something is to go that is not understood, so that it is asked for.
  bool lacks_place = false;

  friend bool operator==(const PartialRequest&, const PartialRequest&) = default;
};

/// What the speaker says in an utterance besides what the form of the utterance is of, and what has
/// to wait for that: "put the ball on the left, and then tell me where it is".
struct Sequel {
  /// As somebody would say it next; empty for nothing.
  std::string words;
  /// Whether it asks a question, which has an answer whatever became of what it waits for.
  bool is_question = false;
  /// The words are said only if the answer to the question is yes, "if the ball is red, take it",
  /// or if the request is done.
  bool is_conditional = false;
  /// What is said if that answer is no, or the request cannot be done; empty for nothing.
  std::string otherwise = {};

  friend bool operator==(const Sequel&, const Sequel&) = default;
};

enum class InterpretationState {
  /// More words may come; the forms are partial ones.
  unfinished,
  /// All words have been heard.
  finished,
  /// Finished, and readings without support have been removed.
  pruned
};

/// All readings of an utterance in one form, overwritten after each word. Parts common to readings
/// are stored once; every alternative lists its readings, so pruning means removing readings.
struct PackedLogicalForm {
  EntryPointer<PhonString> utterance;
  /// The utterance as it was said; a question mark at its end makes a question of a statement.
  std::string text;
  /// How many utterances came before it.
  std::int32_t turn = 0;
  /// Number of words heard so far.
  std::int32_t string_position = 0;
  InterpretationState state = InterpretationState::unfinished;
  /// The likeliest first; empty if nothing was understood.
  std::vector<Reading> readings;
  /// Roots of the readings; several roots of one reading are unconnected fragments.
  std::vector<PackedValue> roots;
  std::vector<PackedNominal> nominals;
  std::vector<Unparsable> unparsable;
  std::vector<SpellingCorrection> corrections;
  /// If only a request in the utterance is understood, which the form is of.
  std::optional<PartialRequest> partial = {};
  /// The thing that it names, if it is a remark or not understood: "it" may stand for that next.
  std::optional<LogicalForm> mention = {};
  /// What waits for it.
  std::optional<Sequel> sequel = {};

  friend bool operator==(const PackedLogicalForm&, const PackedLogicalForm&) = default;
};

/// Support by other knowledge for or against one relation of a packed logical form, such as the
/// attachment of "near the box" to a thing that is, or is not, seen near a box.
struct InterpretationSupport {
  std::string head;
  std::string mode;
  std::string dependent;
  bool supported = true;

  friend bool operator==(const InterpretationSupport&, const InterpretationSupport&) = default;
};

/// Announces a component that reports which readings are supported by the rest of the system.
/// Deleted when the component ends.
struct ContextSource {
  std::string component;
};

/// Report of such a component about a finished form that has several readings.
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
  reject,
  /// About the robot itself: thanks, "who are you?", "what can you do?".
  small_talk
};

/// The speech act of an utterance.
struct DialogueMove {
  DialogueMoveType type = DialogueMoveType::none;
  LogicalForm content;
  /// Other readings, the likelier first: one of them is meant if the content makes no sense.
  std::vector<LogicalForm> alternatives;
  /// Words that were taken for others.
  std::vector<SpellingCorrection> corrections;
  /// How many utterances came before it.
  std::int32_t turn = 0;
  /// Explanation for the speaker of the part not understood; otherwise empty.
  std::string problem;
  EntryPointer<PhonString> utterance;
  /// Type name of the action that a directive asks for, as the lexicon's verbs say; else empty.
  std::string action;
  /// If it is a directive that is only done if the speaker agrees, since the rest of the utterance
  /// is not understood.
  std::optional<PartialRequest> partial = {};
  /// The thing that it names, if it is a remark or not understood.
  std::optional<LogicalForm> mention = {};
  /// What waits for it.
  std::optional<Sequel> sequel = {};
};

/// Somebody points at a place on the table: what "this" and "the cube here" are about, until
/// another place is pointed at. Whoever sees it adds it; the entry that was written last counts.
struct Pointing {
  /// On the table, metres, as in the boxes of vision's objects.
  double x = 0;
  double y = 0;
  /// Microseconds since the system began; only needed to become stale with time.
  std::optional<std::int64_t> time = {};
  /// Whether the hand stays there, so that it does not become stale; if nothing is said, it does
  /// not.
  std::optional<bool> held = {};

  friend bool operator==(const Pointing&, const Pointing&) = default;
};

/// A gesture while a dialogue move was made.
struct PointingUse {
  EntryPointer<Pointing> pointing;
  /// Version of that entry.
  std::uint64_t version = 0;
  /// Whether the move is about what was pointed at.
  bool taken_up = false;

  friend bool operator==(const PointingUse&, const PointingUse&) = default;
};

/// A thing mentioned in a dialogue move, which later moves can refer to.
struct DiscourseReferent {
  /// Nominal that introduced it.
  std::string nominal;
  std::string proposition;
  bool is_plural = false;
  /// Proxies of the perceived things that it may be; one if it is certain.
  std::vector<std::string> proxies;
  /// Whether a question asked for it.
  bool is_answer = false;

  friend bool operator==(const DiscourseReferent&, const DiscourseReferent&) = default;
};

/// What a phrase of a dialogue move stands for by what was said before.
struct PronounReferents {
  std::string nominal;
  /// Proxies of what is perceived.
  std::vector<std::string> proxies;

  friend bool operator==(const PronounReferents&, const PronounReferents&) = default;
};

/// Where something is to be: in a relation to landmarks, or in a part of what things are on.
struct DirectivePlace {
  /// A relation (near, left, right, front, back, on, between, in, away ...), or without landmarks a
  /// part: left, left-edge, front-left-corner, centre, edge, corner, elsewhere, table, there ...;
  /// or measured: midway, equidistant, in-line, other-side, both-sides, roomiest; or how several
  /// things are arranged: in-row, in-row-as-named, in-two-rows, in-column, in-ring, apart.
  std::string relation;
  /// Proxies; several are meant together.
  std::vector<std::string> landmarks;
  /// How far something goes to a side, or how wide the gap to a landmark is; metres, 0 if nothing
  /// is said.
  double distance = 0;

  friend bool operator==(const DirectivePlace&, const DirectivePlace&) = default;
};

/// Whether the relation of a DirectivePlace is one that things have together: a row, a ring, far
/// from each other.
inline bool is_arrangement(std::string_view relation) {
  return relation == "in-row" || relation == "in-row-as-named" || relation == "in-two-rows" ||
         relation == "in-column" || relation == "in-ring" || relation == "apart";
}

/// What is to be done with some things.
struct DirectiveStep {
  /// As the lexicon's verbs say, such as Put.
  std::string action;
  /// Proxies. None if nothing is said, as in "stop" and "put it down".
  std::vector<std::string> things;
  /// So many of the things, as in "one of the balls"; 0 for all of them.
  std::int32_t number = 0;
  /// All of them are to hold; empty if nothing is said.
  std::vector<DirectivePlace> places;
  /// Kind of feature that the things are to be sorted by, or a measure: height, width, volume, from
  /// the left, or with "-down" from the right; `as_tower` or `by_the_way`; else empty.
  std::string by;

  friend bool operator==(const DirectiveStep&, const DirectiveStep&) = default;
};

/// Of several things whose height is asked for as that of a tower.
inline constexpr std::string_view as_tower = "as-tower";

/// Of what somebody may do as a request says: "now you may put it there".
inline constexpr std::string_view by_the_way = "by-the-way";

/// Things mentioned in a dialogue move. Added when binding has processed everything said before.
struct MoveReferents {
  EntryPointer<DialogueMove> move;
  std::int32_t turn = 0;
  /// Nothing that was spoken of before can be referred to after a move that was not.
  bool understood = true;
  /// What pronouns of the move stand for, phrases such as "the others", and what is pointed at.
  std::vector<PronounReferents> pronouns;
  /// The subject of the move first.
  std::vector<DiscourseReferent> referents;
  /// Nothing if nobody pointed.
  std::optional<PointingUse> pointing = {};
  /// What a request asks to do with things, one after the other; empty for other moves.
  std::vector<DirectiveStep> steps = {};
  /// It is only asked whether the steps are possible.
  bool asks_whether_possible = false;
  /// A request is not clear, or not agreed to: the robot asks back, or says why it cannot be.
  bool is_unclear = false;
  /// The steps take the place of those of the request before: "no, to the left of it".
  bool corrects = false;
  /// The steps are to be done before what was asked for: "take the box away first".
  bool comes_first = false;
  /// Utterance with the request that the robot has proposed to do, and the speaker agrees to.
  std::optional<EntryPointer<PhonString>> agrees_to = {};
};

/// Relation of a turn of a dialogue to an earlier one.
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
  /// The contribution that it is related to; null for something new.
  AnyEntryPointer to;

  friend bool operator==(const DialogueTurn&, const DialogueTurn&) = default;
};

/// All turns of the dialogue; there is one such entry.
struct DialogueStructure {
  std::vector<DialogueTurn> turns;
};

/// A logical form to be said, for the realiser.
struct ContentPlanningGoal {
  LogicalForm content;
  /// Said if there are no words for the content; without nominals for nothing.
  LogicalForm simpler;
  /// The dialogue move that this is a reply to, and the utterance of that; null for what is said
  /// unasked.
  EntryPointer<DialogueMove> reply_to;
  EntryPointer<PhonString> utterance;
  RhetoricalRelation relation = RhetoricalRelation::narration;
};

/// A sentence that is, or was, said by the robot.
struct SpokenOutputItem {
  std::string text;
  /// As in ContentPlanningGoal.
  EntryPointer<DialogueMove> reply_to;
  EntryPointer<PhonString> utterance;
  RhetoricalRelation relation = RhetoricalRelation::narration;
  bool spoken = false;
};

/// The id of the item for a content planning goal.
inline std::string spoken_id(const Address& goal) {
  return "words for " + goal.id;
}

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
CASTOR_REFLECT(SpellingCorrection, word, meant)
CASTOR_REFLECT(PartialRequest, left_out, words, lacks_place)
CASTOR_REFLECT(Sequel, words, is_question, is_conditional, otherwise)
CASTOR_REFLECT_ENUM(InterpretationState, unfinished, finished, pruned)
CASTOR_REFLECT(PackedLogicalForm, utterance, text, turn, string_position, state, readings, roots,
               nominals, unparsable, corrections, partial, mention, sequel)
CASTOR_REFLECT(InterpretationSupport, head, mode, dependent, supported)
CASTOR_REFLECT_ENUM(DialogueMoveType, none, assertion, action_directive, question_w, question_yn,
                    opening, closing, accept, reject, small_talk)
CASTOR_REFLECT(ContextSource, component)
CASTOR_REFLECT(ContextInfo, form, supports)
CASTOR_REFLECT(DialogueMove, type, content, alternatives, corrections, turn, problem, utterance,
               action, partial, mention, sequel)
CASTOR_REFLECT(Pointing, x, y, time, held)
CASTOR_REFLECT(PointingUse, pointing, version, taken_up)
CASTOR_REFLECT(DiscourseReferent, nominal, proposition, is_plural, proxies, is_answer)
CASTOR_REFLECT(PronounReferents, nominal, proxies)
CASTOR_REFLECT(DirectivePlace, relation, landmarks, distance)
CASTOR_REFLECT(DirectiveStep, action, things, number, places, by)
CASTOR_REFLECT(MoveReferents, move, turn, understood, pronouns, referents, pointing, steps,
               asks_whether_possible, is_unclear, corrects, comes_first, agrees_to)
CASTOR_REFLECT_ENUM(RhetoricalRelation, narration, answer, acceptance, correction,
                    clarification_question, clarification, greeting)
CASTOR_REFLECT(DialogueTurn, speaker, contribution, type, relation, to)
CASTOR_REFLECT(DialogueStructure, turns)
CASTOR_REFLECT(ContentPlanningGoal, content, simpler, reply_to, utterance, relation)
CASTOR_REFLECT(SpokenOutputItem, text, reply_to, utterance, relation, spoken)

} // namespace castor::communication
